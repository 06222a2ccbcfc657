//! Shader of a pass from an engine, and the meaning of its bindings.

use std::path::PathBuf;

use shader_import::{ShaderFile, Stage};

use crate::Expression;
use crate::shader::Sampling;

/// A shader in a file of its own, with bindings that filter.toml explains.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PassShader {
    /// Its file, and how to compile it.
    pub file: ShaderFile,
    /// Textures that a fragment shader writes, by location; `output` is the picture.
    pub targets: Vec<String>,
    /// Mip level of the targets that it writes; 0 if left out.
    pub level: Option<Expression>,
    /// Shader of the triangle's corners; the program's own if left out.
    pub vertex: Option<VertexShader>,
    /// Meanings of bindings.
    pub bindings: Vec<Binding>,
    /// Values of specialisation constants (`override` of WGSL), by name or number.
    pub constants: Vec<(String, Expression)>,
}

impl PassShader {
    /// Lists the expressions that name parameters, except values of uniform blocks.
    pub(crate) fn list_expressions(&self) -> impl Iterator<Item = &Expression> {
        let levels = self
            .bindings
            .iter()
            .filter_map(|binding| binding.level.as_ref());
        let constants = self.constants.iter().map(|(_, value)| value);
        constants.chain(levels).chain(&self.level)
    }

    /// Lists its stages, each as a shader of its own: itself, then the vertex stage if it names
    /// one.
    pub(crate) fn stages(&self) -> Vec<PassShader> {
        let vertex = self.vertex.as_ref().map(|vertex| PassShader {
            file: ShaderFile {
                path: vertex.path.clone(),
                entry: vertex.entry.clone(),
                stage: Stage::Vertex,
                ..self.file.clone()
            },
            targets: Vec::new(),
            ..self.clone()
        });
        [self.clone()].into_iter().chain(vertex).collect()
    }
}

/// Vertex stage of a fragment shader.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct VertexShader {
    /// The file, relative to the filter's folder.
    pub path: PathBuf,
    /// Entry point.
    pub entry: String,
}

/// Meaning of one binding of a shader.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Binding {
    /// Place in the shader.
    pub place: BindingPlace,
    /// Texture that it reads or writes: `color`, `velocity`, `depth`, `output` or a [[texture]].
    pub texture: Option<String>,
    /// The only mip level that it reads or writes. If left out, it reads all and writes 0.
    pub level: Option<Expression>,
    /// Sampling by a sampler, or by a combined image sampler.
    pub sampling: Sampling,
    /// Values of a uniform block, by member.
    pub values: Vec<(String, Vec<Expression>)>,
    /// Keys that filter.toml has for it, except those of its place.
    pub keys: Vec<&'static str>,
    /// Line in filter.toml.
    pub line: usize,
}

/// Place of a resource in a shader.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum BindingPlace {
    /// `@group` and `@binding` of WGSL, `set` and `binding` of GLSL.
    Bound {
        /// Group or set.
        group: u32,
        /// Number in the group.
        binding: u32,
    },
    /// The variable of that name, wherever the compiler puts it.
    Named(String),
    /// The block of push constants.
    PushConstants,
    /// The block that a compiler of HLSL or Slang makes of uniforms outside of any block.
    Globals,
}

impl std::fmt::Display for BindingPlace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Bound { group, binding } => write!(f, "group {group}, binding {binding}"),
            Self::Named(name) => write!(f, "\"{name}\""),
            Self::PushConstants => write!(f, "push constants"),
            Self::Globals => write!(f, "globals"),
        }
    }
}
