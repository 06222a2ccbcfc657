//! Bindings of a stage.

use serde_json::{Value, json};
use wgpu::naga::ScalarKind;

use super::expressions::describe;
use crate::shader::{EntryPoint, Role, Shader, Variable};

/// Lists the bindings that an entry point uses.
pub(super) fn list_bindings(shader: &Shader, entry: &EntryPoint) -> Vec<Value> {
    let describe_one = |index: &usize| {
        let Variable {
            binding,
            resource,
            level,
            ..
        } = &shader.variables[*index];
        let level = level.as_ref().map(describe);
        match shader.variables[*index].role {
            Role::Read(kind) => json!({
                "binding": binding,
                "role": "read",
                "resource": resource,
                "kind": match kind {
                    ScalarKind::Uint => "uint",
                    ScalarKind::Sint => "sint",
                    _ => "float",
                },
                "filterable": entry.interpolated.contains(index),
                "level": level,
            }),
            Role::Write(format) => json!({
                "binding": binding, "role": "write", "resource": resource, "format": format, "level": level,
            }),
            Role::Block(block) => {
                let block = &shader.blocks[block];
                let numbers = block.numbers.iter();
                let numbers = numbers
                    .map(|number| json!([number.offset, number.kind, describe(&number.value)]));
                json!({
                    "binding": binding,
                    "role": "block",
                    "bytes": block.buffer_bytes(),
                    "storage": block.is_storage,
                    "numbers": numbers.collect::<Vec<_>>(),
                })
            }
            Role::Sampler(sampler) => json!({
                "binding": binding, "role": "sampler", "filter": sampler.filter, "mip": sampler.mip_filter, "wrap": sampler.wrap,
            }),
        }
    };
    entry.variables.iter().map(describe_one).collect()
}
