//! filter.toml of a filter whose passes have the WGSL that the program translated their shaders to.

use serde_json::{Value, json};
use toml::Table;

use super::expressions::write;
use super::modules::{ENTRY, file_name};
use crate::shader::{Role, Shader, Variable, list_members};
use crate::{Filter, Pass};

/// Keys of a pass that a translated module does not need: they are part of it, or follow below.
const LEFT_OUT: [&str; 6] = [
    "shader_pass",
    "binding",
    "constants",
    "conditions",
    "defines",
    "compiler",
];

/// Binds the translated modules in the text of filter.toml, without its comments; text without a
/// foreign shader stays as it is.
pub(super) fn rewrite(filter: &Filter, text: String) -> String {
    if filter.passes.iter().all(|pass| pass.shader.is_none()) {
        return text;
    }
    let mut table: Table = text.parse().expect("the filter was read from it");
    let passes = table.get_mut("pass").and_then(toml::Value::as_array_mut);
    for (entry, pass) in passes.into_iter().flatten().zip(&filter.passes) {
        let entry = entry.as_table_mut().expect("a pass is a table");
        if pass.shader.is_some() {
            entry.retain(|key, _| !LEFT_OUT.contains(&key));
            entry.extend(describe_pass(filter, pass));
        }
    }
    table.to_string()
}

/// Describes the shader and the bindings of a pass.
fn describe_pass(filter: &Filter, pass: &Pass) -> Table {
    let stages = filter.stages(pass);
    let file = |stage: usize| file_name(filter, pass.shaders[stage]);
    let mut own = json!({ "shader": file(0), "entry": ENTRY, "stage": "compute" });
    if stages[0].1.is_fragment() {
        own["stage"] = json!("fragment");
    }
    if stages.len() > 1 {
        own["vertex"] = json!(ENTRY);
        own["vertex_shader"] = json!(file(1));
    }
    let bindings = stages
        .iter()
        .enumerate()
        .flat_map(|(group, (shader, entry))| {
            let variables = entry
                .variables
                .iter()
                .map(|index| &shader.variables[*index]);
            variables.map(move |variable| describe_binding(shader, group, variable))
        });
    own["binding"] = bindings.collect();
    let table = Table::try_from(own);
    table.expect("no value is missing")
}

fn describe_binding(shader: &Shader, group: usize, variable: &Variable) -> Value {
    let mut own = json!({ "group": group, "binding": variable.binding });
    if let Some(level) = &variable.level {
        own["level"] = write(level);
    }
    match variable.role {
        Role::Read(_) | Role::Write(_) => own["texture"] = json!(variable.resource),
        Role::Sampler(it) => {
            own["sampler"] = json!(it.filter);
            own["mip_filter"] = json!(it.mip_filter);
            own["wrap"] = json!(it.wrap);
        }
        Role::Block(block) => {
            let mut globals = shader.module.global_variables.iter().map(|(_, own)| own);
            let at = |binding: &naga::ResourceBinding| binding.binding == variable.binding;
            let global = globals.find(|own| own.binding.as_ref().is_some_and(at));
            let ty = global.expect("the module has the block").ty;
            let members = list_members(&shader.module, ty, &|_, _| 0).unwrap_or_default();
            let starts: Vec<u32> = members.iter().map(|member| member.offset).collect();
            // By their offsets: naga changes some names. An array without a length has the numbers
            // up to the end.
            for (at, start) in starts.iter().enumerate() {
                let end = starts.get(at + 1).copied().unwrap_or(u32::MAX);
                let numbers = shader.blocks[block].numbers.iter();
                let numbers = numbers.filter(|it| (*start..end).contains(&it.offset));
                let values = numbers.map(|number| write(&number.value));
                own["values"][format!("@{start}")] = values.collect();
            }
        }
    }
    own
}
