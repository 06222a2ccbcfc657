//! Declarations of a kernel file, found with naga's reflection; needs no adapter.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use shader_import::WgslText;
use wgpu::naga::{GlobalVariable, Handle, Module, ShaderStage};

use super::block::UniformBlock;
use super::compiled_by::CompiledBy;
use super::entry_point::{EntryPoint, find_entry_points};
use super::stack::guard;
use super::variable::{Variable, find_variable};
use crate::FilterError;

/// WGSL that is appended to every filter's kernels.
pub(crate) const COMMON: &str = include_str!("../../../../shaders/common.wgsl");

/// Kernels of a filter with common.wgsl appended, and what they declare.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shader {
    /// The filter's file.
    pub path: PathBuf,
    /// The kernels themselves, validated; those of the filter's WGSL file with common.wgsl.
    pub module: Arc<Module>,
    /// Resource variables of group 0, in order of declaration.
    pub variables: Vec<Variable>,
    /// Uniform blocks, by the index in `Role::Block`.
    pub blocks: Vec<UniformBlock>,
    /// True if the kernels read how the camera moved.
    pub reads_reprojection: bool,
    /// Compute entry points.
    pub entry_points: Vec<EntryPoint>,
    /// Output of its language's compiler, if parameters set specialisation constants in it.
    pub compiled: Option<Arc<Vec<u8>>>,
    /// Hash of its WGSL, or of the output of its language's compiler.
    pub code_hash: String,
    /// Compiler that made it, if its language needs one.
    pub compiled_by: Option<CompiledBy>,
}

/// Hashes the code of a shader.
pub(crate) fn hash_code(code: &[u8]) -> String {
    blake3::hash(code).to_hex().to_string()
}

impl Shader {
    /// Parses and validates the kernels at `path`, with common.wgsl appended.
    pub fn parse(path: &Path, kernels: &str) -> Result<Self, FilterError> {
        guard(path, "reads WGSL", || Self::parse_here(path, kernels))
    }

    fn parse_here(path: &Path, kernels: &str) -> Result<Self, FilterError> {
        let source = WgslText::new(path, kernels, COMMON);
        let module = source.parse()?;
        source.refuse_overrides(&module)?;
        let info = source.validate(&module)?;
        let handles: Vec<Handle<GlobalVariable>> = module
            .global_variables
            .iter()
            .filter(|(_, variable)| variable.binding.is_some())
            .map(|(handle, _)| handle)
            .collect();
        let mut blocks = Vec::new();
        let variables = handles
            .iter()
            .map(|handle| find_variable(&source, &module, *handle, &mut blocks))
            .collect::<Result<Vec<_>, _>>()?;
        let find_line = |function: &str| source.line_of_function(function);
        let mut entry_points = find_entry_points(&module, &info, &handles, &variables, &find_line);
        // Shaders of other stages are named with their bindings.
        entry_points.retain(|entry| entry.stage == ShaderStage::Compute);
        for entry in &entry_points {
            let checked = entry.usage.check(&entry.name);
            checked.map_err(|reason| source.fault(entry.line, reason))?;
        }
        Ok(Self {
            path: path.to_owned(),
            reads_reprojection: kernels.contains("before_camera(")
                || kernels.contains("frame.reprojection"),
            entry_points,
            variables,
            blocks,
            compiled: None,
            compiled_by: None,
            code_hash: hash_code(kernels.as_bytes()),
            module: Arc::new(module),
        })
    }

    /// Finds a binding of group 0 that no variable has.
    pub fn find_free_binding(&self) -> u32 {
        let used = |binding| (self.variables.iter()).any(|variable| variable.binding == binding);
        let free = (0..).find(|binding| !used(*binding));
        free.expect("a kernel has fewer variables than there are numbers")
    }

    /// Finds an entry point by name.
    pub fn entry_point(&self, name: &str) -> Option<&EntryPoint> {
        self.entry_points.iter().find(|entry| entry.name == name)
    }
}
