//! Declarations of a kernel file, found with naga's reflection; needs no adapter.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};
use wgpu::naga::{GlobalVariable, Handle, Module, ShaderStage, front};

use super::block::UniformBlock;
use super::compiled_by::CompiledBy;
use super::entry_point::{EntryPoint, find_entry_points};
use super::nesting::check_nesting;
use super::source::Source;
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
    /// Compiler that made it, if its language needs one.
    pub compiled_by: Option<CompiledBy>,
}

/// Capabilities of every device; kernels can `enable` nothing more.
pub(crate) const CAPABILITIES: Capabilities = Capabilities::MULTISAMPLED_SHADING
    .union(Capabilities::CUBE_ARRAY_TEXTURES)
    .union(Capabilities::SHADER_FLOAT16_IN_FLOAT32);

/// Makes a validator of shaders that engines wrote, which may compute in 64 bits.
pub(crate) fn engine_validator() -> Validator {
    Validator::new(ValidationFlags::all(), CAPABILITIES | Capabilities::FLOAT64)
}

/// Parses WGSL without common.wgsl.
pub(crate) fn parse_wgsl(path: &Path, text: &str) -> Result<Module, FilterError> {
    check_nesting(path, text)?;
    parse_source(&Source::new(path, text, ""))
}

fn parse_source(source: &Source) -> Result<Module, FilterError> {
    let options = front::wgsl::Options {
        capabilities: CAPABILITIES,
        ..front::wgsl::Options::new()
    };
    let mut parser = front::wgsl::Frontend::new_with_options(options);
    parser.parse(&source.text).map_err(|error| {
        let message = error.emit_to_string_with_path(&source.text, source.name());
        source.refuse(error.location(&source.text), &message)
    })
}

impl Shader {
    /// Parses and validates the kernels at `path`, with common.wgsl appended. Refuses text that is
    /// nested too deeply before naga sees it.
    pub fn parse(path: &Path, kernels: &str) -> Result<Self, FilterError> {
        check_nesting(path, kernels)?;
        guard(path, "reads WGSL", || Self::parse_here(path, kernels))
    }

    fn parse_here(path: &Path, kernels: &str) -> Result<Self, FilterError> {
        let source = Source::new(path, kernels, COMMON);
        let module = parse_source(&source)?;
        source.refuse_overrides(&module)?;
        let info = Validator::new(ValidationFlags::all(), CAPABILITIES)
            .validate(&module)
            .map_err(|error| {
                let message = error.emit_to_string_with_path(&source.text, source.name());
                source.refuse(error.location(&source.text), &message)
            })?;
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
            checked.map_err(|reason| source.at(entry.line, reason))?;
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
