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
    let mut description = json!({ "shader": file(0), "entry": ENTRY, "stage": "compute" });
    if stages[0].1.is_fragment() {
        description["stage"] = json!("fragment");
    }
    if stages.len() > 1 {
        description["vertex"] = json!(ENTRY);
        description["vertex_shader"] = json!(file(1));
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
    description["binding"] = bindings.collect();
    let table = Table::try_from(description);
    table.expect("no value is missing")
}

fn describe_binding(shader: &Shader, group: usize, variable: &Variable) -> Value {
    let mut description = json!({ "group": group, "binding": variable.binding });
    if let Some(level) = &variable.level {
        description["level"] = write(level);
    }
    match variable.role {
        Role::Read(_) | Role::Write(_) => description["texture"] = json!(variable.resource),
        Role::Sampler(sampler) => {
            description["sampler"] = json!(sampler.filter);
            description["mip_filter"] = json!(sampler.mip_filter);
            description["wrap"] = json!(sampler.wrap);
        }
        Role::Block(block) => {
            let mut globals = shader
                .module
                .global_variables
                .iter()
                .map(|(_, global)| global);
            let at = |binding: &naga::ResourceBinding| binding.binding == variable.binding;
            let global = globals.find(|global| global.binding.as_ref().is_some_and(at));
            let ty = global.expect("the module has the block").ty;
            let members = list_members(&shader.module, ty, &|_, _| 0).unwrap_or_default();
            let starts: Vec<u32> = members.iter().map(|member| member.offset).collect();
            // By their offsets: naga changes some names. An array without a length has the numbers
            // up to the end.
            for (at, start) in starts.iter().enumerate() {
                let end = starts.get(at + 1).copied().unwrap_or(u32::MAX);
                let numbers = shader.blocks[block].numbers.iter();
                let numbers = numbers.filter(|number| (*start..end).contains(&number.offset));
                let values = numbers.map(|number| write(&number.value));
                description["values"][format!("@{start}")] = values.collect();
            }
        }
    }
    description
}
