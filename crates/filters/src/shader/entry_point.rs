//! Entry points of a kernel file.

use std::collections::BTreeSet;

use wgpu::naga::valid::{GlobalUse, ModuleInfo};
use wgpu::naga::{GlobalVariable, Handle, Module, ShaderStage};

use super::noise::reads_frame_index;
use super::resource_usage::ResourceUsage;
use super::source::Source;
use super::variable::{Role, Variable, written_texture};

/// A kernel.
#[derive(Clone, Debug)]
pub(crate) struct EntryPoint {
    pub name: String,
    /// Invocations per workgroup.
    pub workgroup_size: [u32; 3],
    /// Indices of the variables that it uses.
    pub variables: Vec<usize>,
    /// Names of the textures that it reads.
    pub reads: BTreeSet<String>,
    /// Names of the textures that it writes.
    pub writes: BTreeSet<String>,
    /// True if it reads the frame's index, from which noise is drawn.
    pub draws_noise: bool,
    /// Resources that it asks of a device.
    pub usage: ResourceUsage,
    /// Line in the WGSL file, from 1.
    pub line: Option<usize>,
}

impl EntryPoint {
    /// Names the textures that it both reads and writes: those have two copies, exchanged after each iteration.
    pub fn exchanged_textures(&self) -> impl Iterator<Item = &String> {
        self.reads.intersection(&self.writes)
    }
}

/// Lists the compute entry points. `handles` are those of `variables`.
pub(super) fn find_entry_points(
    source: &Source,
    module: &Module,
    module_info: &ModuleInfo,
    handles: &[Handle<GlobalVariable>],
    variables: &[Variable],
) -> Vec<EntryPoint> {
    module
        .entry_points
        .iter()
        .enumerate()
        .filter(|(_, entry)| entry.stage == ShaderStage::Compute)
        .map(|(index, entry)| {
            let info = module_info.get_entry_point(index);
            let used: Vec<usize> = (0..handles.len())
                .filter(|variable| info[handles[*variable]] != GlobalUse::empty())
                .collect();
            let used_variables = used.iter().map(|index| &variables[*index]);
            let (mut reads, mut writes) = (BTreeSet::new(), BTreeSet::new());
            for Variable { name, role, .. } in used_variables {
                match role {
                    Role::Uniform => {}
                    Role::Read(_) => _ = reads.insert(name.clone()),
                    Role::Write(_) => _ = writes.insert(written_texture(name).to_owned()),
                }
            }
            EntryPoint {
                name: entry.name.clone(),
                workgroup_size: entry.workgroup_size,
                variables: used,
                reads,
                writes,
                draws_noise: reads_frame_index(module, &entry.function),
                usage: ResourceUsage::of(module, module_info, index),
                line: source.line_of_function(&entry.name),
            }
        })
        .collect()
}
