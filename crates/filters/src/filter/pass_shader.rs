//! Shader of a pass from an engine, and the meaning of its bindings.

use std::path::PathBuf;

use crate::Expression;
use crate::shader::Sampling;

/// Stage of a shader.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Stage {
    /// One invocation per texel writes storage textures.
    #[default]
    Compute,
    /// A triangle over the whole picture; each fragment writes the render targets.
    Fragment,
    /// Corners of the triangle of a fragment shader. Not a stage of a pass by itself.
    #[serde(skip)]
    Vertex,
}

/// A shader in a file of its own, with bindings that filter.toml explains.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PassShader {
    /// The file, relative to the filter's folder.
    pub file: PathBuf,
    /// Pass of a ShaderLab file, if it has several.
    pub shader_pass: Option<LabPass>,
    /// Entry point.
    pub entry: String,
    /// Stage of the entry point.
    pub stage: Stage,
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
    /// Conditions of WESL that are true.
    pub conditions: Vec<String>,
    /// Macros of its compiler, each as `NAME=value`.
    pub defines: Vec<String>,
    /// Program that compiles it; the first that can if left out.
    pub compiler: Option<String>,
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
            file: vertex.file.clone(),
            entry: vertex.entry.clone(),
            stage: Stage::Vertex,
            targets: Vec::new(),
            ..self.clone()
        });
        [self.clone()].into_iter().chain(vertex).collect()
    }
}

/// Pass of a file in Unity's ShaderLab.
#[derive(Clone, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(untagged)]
pub(crate) enum LabPass {
    /// Its place, from 0.
    Place(usize),
    /// Its `Name`.
    Name(String),
}

/// Vertex stage of a fragment shader.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct VertexShader {
    /// The file, relative to the filter's folder.
    pub file: PathBuf,
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
