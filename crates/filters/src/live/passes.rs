//! Passes of a filter as data.

use std::collections::BTreeSet;

use serde::Serialize;

use super::bindings::LiveBinding;
use super::modules::{ENTRY, LiveModule, LiveVertex};
use crate::filter::Count;
use crate::gpu::list_target_formats;
use crate::shader::Role;
use crate::{Expression, Filter, Format, Pass};

/// A pass.
#[derive(Clone, Debug, Serialize)]
pub(super) struct LivePass {
    /// Name in messages.
    entry: String,
    stage: &'static str,
    /// Index of its module.
    module: usize,
    /// Entry point.
    kernel: String,
    /// Vertex stage of fragments.
    vertex: Option<LiveVertex>,
    workgroup: [u32; 2],
    workgroup_per_texel: bool,
    /// Texture whose texels it runs over; none for the picture's.
    over: Option<String>,
    repeat: Count,
    /// Textures that fragments write, by location.
    targets: Vec<String>,
    /// Mip level of those that it writes.
    level: Option<Expression>,
    /// True if texels of exchanged textures keep their content unless it writes them.
    keeps_unwritten: bool,
    /// Textures with two copies, which change places after every run.
    exchanged: Vec<String>,
    writes: BTreeSet<String>,
    bindings: Vec<LiveBinding>,
}

impl LivePass {
    /// Describes a pass. Adds the module of its triangle if it needs one.
    pub fn new(filter: &Filter, pass: &Pass, modules: &mut Vec<LiveModule>) -> Self {
        let (shader, entry) = (filter.shader(pass), filter.entry_point(pass));
        let [x, y, _] = entry.workgroup_size;
        Self {
            entry: pass.entry.clone(),
            stage: match entry.is_fragment() {
                true => "fragment",
                false => "compute",
            },
            module: pass.shaders[0],
            kernel: match pass.shader {
                Some(_) => ENTRY.to_owned(),
                None => entry.name.clone(),
            },
            vertex: LiveVertex::find(filter, pass, modules),
            workgroup: [x, y],
            workgroup_per_texel: pass.workgroup_per_texel,
            over: pass.over.clone(),
            repeat: pass.repeat.clone(),
            targets: pass.list_targets().cloned().collect(),
            level: pass.shader.as_ref().and_then(|shader| shader.level.clone()),
            keeps_unwritten: entry.keeps_unwritten,
            exchanged: entry.exchanged_textures().cloned().collect(),
            writes: entry.writes.clone(),
            bindings: LiveBinding::list(shader, entry),
        }
    }
}

/// Formats that every WebGPU device stores.
const STORED: [Format; 15] = [
    Format::Rgba8Unorm,
    Format::Rgba8Uint,
    Format::Rgba8Sint,
    Format::Rgba16Uint,
    Format::Rgba16Sint,
    Format::Rgba16Float,
    Format::R32Uint,
    Format::R32Sint,
    Format::R32Float,
    Format::Rg32Uint,
    Format::Rg32Sint,
    Format::Rg32Float,
    Format::Rgba32Uint,
    Format::Rgba32Sint,
    Format::Rgba32Float,
];

/// Finds the optional features of WebGPU that a filter needs.
pub(super) fn find_features(filter: &Filter) -> BTreeSet<&'static str> {
    let mut features = BTreeSet::new();
    let is_packed = |format: &wgpu::TextureFormat| *format == wgpu::TextureFormat::Rg11b10Ufloat;
    for pass in &filter.passes {
        if list_target_formats(filter, pass).iter().any(is_packed) {
            features.insert("rg11b10ufloat-renderable");
        }
        for (shader, entry) in filter.stages(pass) {
            for index in &entry.variables {
                let variable = &shader.variables[*index];
                let is_filtered = entry.interpolated.contains(index);
                match variable.role {
                    Role::Write(format) if !STORED.contains(&format) => {
                        features.insert("texture-formats-tier1");
                    }
                    Role::Read(_)
                        if is_filtered
                            && filter.read_format(&variable.resource).is_full_float() =>
                    {
                        features.insert("float32-filterable");
                    }
                    _ => {}
                }
            }
        }
    }
    features
}
