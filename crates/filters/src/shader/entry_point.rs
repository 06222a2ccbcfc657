//! Entry points of a kernel file.

use std::collections::BTreeSet;

use wgpu::naga::valid::{FunctionInfo, GlobalUse, ModuleInfo};
use wgpu::naga::{GlobalVariable, Handle, Module, ShaderStage};

use super::divergence::find_divergent_barrier;
use super::noise::reads_frame_index;
use super::resource_usage::ResourceUsage;
use super::variable::{Role, Variable};
use super::varying::Varying;

/// A kernel.
#[derive(Clone, Debug)]
pub(crate) struct EntryPoint {
    pub name: String,
    pub stage: ShaderStage,
    /// Invocations per workgroup.
    pub workgroup_size: [u32; 3],
    /// Indices of the variables that it uses.
    pub variables: Vec<usize>,
    /// Indices of the textures among them that it reads through a sampler that interpolates.
    pub interpolated: BTreeSet<usize>,
    /// Locations that a vertex stage or a fragment shader writes; none for a kernel.
    pub locations: Vec<u32>,
    /// Values that it reads: texture coordinates, or the attributes of vertices.
    pub inputs: Vec<Varying>,
    /// Names of the textures that it reads.
    pub reads: BTreeSet<String>,
    /// Names of those among them that it reads with all their mip levels.
    pub reads_whole: BTreeSet<String>,
    /// Names of the textures that it writes.
    pub writes: BTreeSet<String>,
    /// True if texels of a texture that it reads and writes keep their content unless it writes
    /// them, as in engines.
    pub keeps_unwritten: bool,
    /// True if it reads the frame's index, from which noise is drawn.
    pub draws_noise: bool,
    /// Function of a barrier that only some invocations of a workgroup may reach.
    pub divergent_barrier: Option<String>,
    /// Resources that it asks of a device.
    pub usage: ResourceUsage,
    /// Line in the WGSL file, from 1.
    pub line: Option<usize>,
}

impl EntryPoint {
    /// Returns true for a fragment shader.
    pub fn is_fragment(&self) -> bool {
        self.stage == ShaderStage::Fragment
    }

    /// Names the textures that it both reads and writes: those have two copies, exchanged after
    /// each iteration. If it reads single mip levels, one copy is enough.
    pub fn exchanged_textures(&self) -> impl Iterator<Item = &String> {
        self.reads_whole.intersection(&self.writes)
    }
}

/// Lists the entry points. `handles` are those of `variables`, and `find_line` finds the line of a
/// function.
pub(crate) fn find_entry_points(
    module: &Module,
    module_info: &ModuleInfo,
    handles: &[Handle<GlobalVariable>],
    variables: &[Variable],
    find_line: &dyn Fn(&str) -> Option<usize>,
) -> Vec<EntryPoint> {
    module
        .entry_points
        .iter()
        .enumerate()
        .map(|(index, entry)| {
            let info = module_info.get_entry_point(index);
            let used: Vec<usize> = (0..handles.len())
                .filter(|variable| info[handles[*variable]] != GlobalUse::empty())
                .collect();
            let used_variables = used.iter().map(|index| &variables[*index]);
            let (mut reads, mut writes) = (BTreeSet::new(), BTreeSet::new());
            let mut reads_whole = BTreeSet::new();
            for variable in used_variables {
                let resource = || variable.resource.clone();
                match variable.role {
                    Role::Block(_) | Role::Sampler(_) => {}
                    Role::Read(_) => {
                        reads.insert(resource());
                        reads_whole.extend(variable.level.is_none().then(resource));
                    }
                    Role::Write(_) => _ = writes.insert(resource()),
                }
            }
            let function = &entry.function;
            let outputs = (function.result.iter())
                .flat_map(|result| Varying::list(module, result.ty, &result.binding));
            let mut locations: Vec<u32> = outputs.map(|output| output.location).collect();
            locations.sort_unstable();
            EntryPoint {
                name: entry.name.clone(),
                stage: entry.stage,
                workgroup_size: entry.workgroup_size,
                variables: used,
                interpolated: find_interpolated(info, handles, variables),
                locations,
                inputs: (function.arguments.iter())
                    .flat_map(|argument| Varying::list(module, argument.ty, &argument.binding))
                    .collect(),
                reads,
                reads_whole,
                writes,
                keeps_unwritten: false,
                draws_noise: reads_frame_index(module, &entry.function),
                divergent_barrier: find_divergent_barrier(module, entry),
                usage: ResourceUsage::of(module, module_info, index),
                line: find_line(&entry.name),
            }
        })
        .collect()
}

/// Finds the textures that are read through samplers that interpolate.
fn find_interpolated(
    info: &FunctionInfo,
    handles: &[Handle<GlobalVariable>],
    variables: &[Variable],
) -> BTreeSet<usize> {
    let index = |wanted| handles.iter().position(|handle| *handle == wanted);
    let is_linear = |sampler: usize| matches!(variables[sampler].role, Role::Sampler(sampling) if sampling.interpolates());
    (info.sampling_set.iter())
        .filter(|pair| index(pair.sampler).is_some_and(is_linear))
        .filter_map(|pair| index(pair.image))
        .collect()
}
