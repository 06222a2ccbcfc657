//! Entry point of a pass, alone in its module and with its specialisation constants set.

use std::collections::BTreeMap;
use std::path::Path;

use wgpu::naga::back::PipelineConstants;
use wgpu::naga::back::pipeline_constants::process_overrides;
use wgpu::naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use wgpu::naga::{Module, ScalarKind, ShaderStage};

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
        Stage::Vertex => ShaderStage::Vertex,
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
                "has no {} entry point \"{}\"; it has: {}; filter.toml names it with {}",
                name_stage(stage),
                shader.entry,
                match names.is_empty() {
                    true => "none".to_owned(),
                    false => names.join(", "),
                },
                match shader.stage {
                    Stage::Vertex => "`vertex` and `vertex_shader`",
                    _ => "`entry` and `stage`",
                }
            ),
        )),
    }
}

/// A specialisation constant of a module.
struct SpecialisationConstant {
    name: Option<String>,
    number: Option<String>,
    is_whole: bool,
}

impl SpecialisationConstant {
    /// Lists those of a module.
    fn list(module: &Module) -> Vec<Self> {
        (module.overrides.iter())
            .map(|(_, constant)| Self {
                name: constant.name.clone().filter(|name| !name.is_empty()),
                number: constant.id.map(|id| id.to_string()),
                is_whole: (module.types[constant.ty].inner.scalar())
                    .is_some_and(|scalar| scalar.kind != ScalarKind::Float),
            })
            .collect()
    }

    fn is_called(&self, name: &str) -> bool {
        [&self.name, &self.number]
            .into_iter()
            .flatten()
            .any(|known| known == name)
    }
}

/// Sets specialisation constants to the values of settings. Those that filter.toml does not name keep the value that the shader
/// gives them. A vertex stage takes those of its fragment shader that it has.
pub(super) fn set_constants(
    shader: &PassShader,
    path: &Path,
    module: &mut Module,
    values: &BTreeMap<String, f64>,
) -> Result<(), FilterError> {
    let constants = SpecialisationConstant::list(module);
    let mut set = PipelineConstants::default();
    for (name, value) in &shader.constants {
        let Some(constant) = constants.iter().find(|it| it.is_called(name)) else {
            if shader.stage == Stage::Vertex {
                continue;
            }
            let known: Vec<String> = (constants.into_iter())
                .filter_map(|constant| constant.name.or(constant.number))
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
        };
        let value = value.evaluate(&|name| values[name]);
        let value = match constant.is_whole {
            true => value.round(),
            false => value,
        };
        // A constant with a name and a number goes by its number.
        let key = constant.number.clone().unwrap_or(name.clone());
        set.insert(key, value);
    }
    let info = validate(path, module)?;
    let set = process_overrides(module, &info, None, &set);
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
