//! Entry point of a pass, alone in its module and with its specialisation constants set.

use std::path::Path;

use wgpu::naga::back::pipeline_constants::process_overrides;
use wgpu::naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use wgpu::naga::{Module, ShaderStage};

use super::{explain, refuse};
use crate::FilterError;
use crate::filter::{PassShader, Stage};
use crate::shader::CAPABILITIES;

/// Validates a module.
pub(super) fn validate(path: &Path, module: &Module) -> Result<ModuleInfo, FilterError> {
    let capabilities = CAPABILITIES | Capabilities::IMMEDIATES | Capabilities::FLOAT64;
    Validator::new(ValidationFlags::all(), capabilities)
        .validate(module)
        .map_err(|error| {
            refuse(
                path,
                format!(
                    "is not valid once translated: {}",
                    explain(error.as_inner())
                ),
            )
        })
}

/// Removes all entry points but the one of the pass.
pub(super) fn keep_entry_point(
    shader: &PassShader,
    path: &Path,
    module: &mut Module,
) -> Result<(), FilterError> {
    let stage = match shader.stage {
        Stage::Compute => ShaderStage::Compute,
        Stage::Fragment => ShaderStage::Fragment,
    };
    let names: Vec<String> = (module.entry_points.iter())
        .map(|entry| format!("{} ({})", entry.name, name_stage(entry.stage)))
        .collect();
    module
        .entry_points
        .retain(|entry| entry.name == shader.entry && entry.stage == stage);
    match module.entry_points.len() {
        1 => Ok(()),
        _ => Err(refuse(
            path,
            format!(
                "has no {} entry point \"{}\"; it has: {}; filter.toml names it with `entry` and `stage`",
                name_stage(stage),
                shader.entry,
                match names.is_empty() {
                    true => "none".to_owned(),
                    false => names.join(", "),
                }
            ),
        )),
    }
}

/// Sets specialisation constants. Those that filter.toml does not name keep the value that the shader gives them.
pub(super) fn set_constants(
    shader: &PassShader,
    path: &Path,
    module: &mut Module,
) -> Result<(), FilterError> {
    let mut names = Vec::new();
    for (_, constant) in module.overrides.iter() {
        let name = constant.name.clone().filter(|name| !name.is_empty());
        let number = constant.id.map(|id| id.to_string());
        names.push((name, number));
    }
    let is = |known: &Option<String>, name: &str| known.as_deref() == Some(name);
    for (name, _) in &shader.constants {
        if !(names.iter()).any(|(own, number)| is(own, name) || is(number, name)) {
            let known: Vec<String> = (names.into_iter())
                .filter_map(|(name, number)| name.or(number))
                .collect();
            return Err(refuse(
                path,
                format!(
                    "has no specialisation constant \"{name}\", which filter.toml sets; it has: {}",
                    match known.is_empty() {
                        true => "none".to_owned(),
                        false => known.join(", "),
                    }
                ),
            ));
        }
    }
    // A constant with a name and a number goes by its number.
    let values = shader.constants.iter().map(|(name, value)| {
        let numbered = names
            .iter()
            .find(|(own, number)| is(own, name) && number.is_some());
        let key = numbered.and_then(|(_, number)| number.clone());
        (key.unwrap_or(name.clone()), *value)
    });
    let info = validate(path, module)?;
    let set = process_overrides(module, &info, None, &values.collect());
    let set = set.map_err(|error| {
        refuse(
            path,
            format!(
                "specialisation constants: {}; `constants` of the pass sets them",
                explain(&error)
            ),
        )
    })?;
    *module = set.0.into_owned();
    Ok(())
}

fn name_stage(stage: ShaderStage) -> &'static str {
    match stage {
        ShaderStage::Compute => "compute",
        ShaderStage::Fragment => "fragment",
        ShaderStage::Vertex => "vertex",
        _ => "other",
    }
}
