//! Passes of a filter, and their bindings.

use std::collections::BTreeSet;

use serde_json::{Value, json};
use wgpu::TextureFormat;

use super::bindings::list_bindings;
use super::expressions::describe;
use super::modules::{ENTRY, describe_vertex};
use crate::gpu::list_target_formats;
use crate::shader::Role;
use crate::{Filter, Pass};

/// Describes a pass. Adds the module of its triangle if it needs one.
pub(super) fn describe_pass(filter: &Filter, pass: &Pass, modules: &mut Vec<Value>) -> Value {
    let (shader, entry) = (filter.shader(pass), filter.entry_point(pass));
    let pass_shader = pass.shader.as_ref();
    json!({
        "entry": pass.entry,
        "stage": if entry.is_fragment() { "fragment" } else { "compute" },
        "module": pass.shaders[0],
        "kernel": pass_shader.map_or(&entry.name[..], |_| ENTRY),
        "vertex": describe_vertex(filter, pass, modules),
        "workgroup": entry.workgroup_size[..2],
        "workgroup_per_texel": pass.workgroup_per_texel,
        "over": pass.over,
        "repeat": pass.repeat,
        "targets": pass.list_targets().collect::<Vec<_>>(),
        "level": pass_shader.and_then(|pass_shader| pass_shader.level.as_ref()).map(describe),
        "keeps_unwritten": entry.keeps_unwritten,
        "exchanged": entry.exchanged_textures().collect::<Vec<_>>(),
        "writes": entry.writes,
        "bindings": list_bindings(shader, entry),
    })
}

/// Lists the optional features of WebGPU that a filter needs.
pub(super) fn list_features(filter: &Filter) -> BTreeSet<&'static str> {
    let mut features = BTreeSet::new();
    for pass in &filter.passes {
        if list_target_formats(filter, pass).contains(&TextureFormat::Rg11b10Ufloat) {
            features.insert("rg11b10ufloat-renderable");
        }
        let stages = filter.stages(pass).into_iter();
        for (shader, entry, index) in stages.flat_map(|(shader, entry)| {
            entry
                .variables
                .iter()
                .map(move |index| (shader, entry, index))
        }) {
            let variable = &shader.variables[*index];
            let is_interpolated = entry.interpolated.contains(index);
            match variable.role {
                Role::Write(format) => {
                    let every_device = wgpu::Features::empty();
                    let format = format.wgpu().guaranteed_format_features(every_device);
                    if !format
                        .allowed_usages
                        .contains(wgpu::TextureUsages::STORAGE_BINDING)
                    {
                        features.insert("texture-formats-tier1");
                    }
                }
                Role::Read(_)
                    if is_interpolated
                        && filter.read_format(&variable.resource).is_full_float() =>
                {
                    features.insert("float32-filterable");
                }
                _ => {}
            }
        }
    }
    features
}
