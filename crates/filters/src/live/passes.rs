//! Passes of a filter as data.

use std::collections::BTreeSet;

use serde::Serialize;

use super::bindings::LiveBinding;
use crate::filter::Count;
use crate::shader::Role;
use crate::{Filter, Format, Pass};

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
    workgroup: [u32; 2],
    workgroup_per_texel: bool,
    /// Texture whose texels it runs over; none for the picture's.
    over: Option<String>,
    repeat: Count,
    /// Textures that fragments write, by location.
    targets: Vec<String>,
    /// True if texels of exchanged textures keep their content unless it writes them.
    keeps_unwritten: bool,
    /// Textures with two copies, which change places after every run.
    exchanged: Vec<String>,
    writes: BTreeSet<String>,
    bindings: Vec<LiveBinding>,
}

impl LivePass {
    pub fn new(filter: &Filter, pass: &Pass) -> Self {
        let (shader, entry) = (filter.shader(pass), filter.entry_point(pass));
        let [x, y, _] = entry.workgroup_size;
        Self {
            entry: pass.entry.clone(),
            stage: match entry.is_fragment() {
                true => "fragment",
                false => "compute",
            },
            module: pass.shaders[0],
            kernel: entry.name.clone(),
            workgroup: [x, y],
            workgroup_per_texel: pass.workgroup_per_texel,
            over: pass.over.clone(),
            repeat: pass.repeat.clone(),
            targets: pass.list_targets().cloned().collect(),
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
    for pass in &filter.passes {
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
