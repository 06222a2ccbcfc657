//! Entry point of a pass, alone in its module and with its specialisation constants set.

use std::path::Path;

use naga::back::PipelineConstants;
use naga::back::pipeline_constants::process_overrides;
use naga::compact::{KeepUnused, compact};
use naga::valid::ModuleInfo;
use naga::{Module, ScalarKind, ShaderStage};

use crate::fault::FileFault;
use crate::language::Language;
use crate::naga_error::explain;
use crate::shader_file::{ShaderFile, Stage};
use crate::spirv::refuse_missing;
use crate::validation::engine_validator;

/// Validates a module.
///
/// # Errors
/// naga refuses it.
pub fn validate(path: &Path, module: &Module) -> Result<ModuleInfo, FileFault> {
    engine_validator().validate(module).map_err(|error| {
        let reason = explain(error.as_inner());
        let reason = format!("is not valid once translated: {reason}");
        FileFault::new(path, None, reason)
    })
}

/// Validates a module, removes all but the shader's entry point and what that uses, and sets the
/// `override`s of WGSL.
///
/// # Errors
/// The module is not valid, lacks the entry point, or lacks a constant.
pub fn keep_entry_point(
    shader: &ShaderFile,
    path: &Path,
    module: &mut Module,
    constants: &[(String, f64)],
) -> Result<(), FileFault> {
    validate(path, module)?;
    remove_others(shader, path, module)?;
    set_overrides(shader, path, module, constants)?;
    compact(module, KeepUnused::No);
    Ok(())
}

/// Removes all entry points but the shader's.
fn remove_others(shader: &ShaderFile, path: &Path, module: &mut Module) -> Result<(), FileFault> {
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
        _ => Err(FileFault::new(
            path,
            None,
            format!(
                "has no {} entry point \"{}\"; it has: {}; filter.toml names it with {}",
                name_stage(stage),
                shader.entry,
                if names.is_empty() {
                    "none".to_owned()
                } else {
                    names.join(", ")
                },
                match shader.stage {
                    Stage::Vertex => "`vertex` and `vertex_shader`",
                    _ => "`entry` and `stage`",
                }
            ),
        )),
    }
}

/// Sets the `override`s of WGSL. Those that filter.toml does not name keep the value that the
/// shader gives them. A vertex stage takes those of its fragment shader that it has.
fn set_overrides(
    shader: &ShaderFile,
    path: &Path,
    module: &mut Module,
    given: &[(String, f64)],
) -> Result<(), FileFault> {
    if !matches!(
        Language::of_shader(shader, path)?,
        Language::Wgsl | Language::Wesl
    ) {
        // SPIR-V got its constants before naga read it.
        return Ok(());
    }
    let mut set = PipelineConstants::default();
    for (name, value) in given {
        let mut constants = module.overrides.iter().map(|(_, constant)| constant);
        let numbered = |id: Option<u16>| id.map(|id| id.to_string());
        let constant = constants.find(|constant| {
            let names = [constant.name.clone(), numbered(constant.id)];
            names.iter().flatten().any(|alias| alias == name)
        });
        let Some(constant) = constant else {
            if shader.stage == Stage::Vertex {
                continue;
            }
            let constants = module.overrides.iter().map(|(_, constant)| constant);
            let known =
                constants.filter_map(|constant| constant.name.clone().or(numbered(constant.id)));
            let known: Vec<String> = known.collect();
            let reason = refuse_missing(name, &known);
            return Err(FileFault::new(path, None, reason));
        };
        let scalar = module.types[constant.ty].inner.scalar();
        let value = if scalar.is_some_and(|scalar| scalar.kind != ScalarKind::Float) {
            value.round()
        } else {
            *value
        };
        // A constant with a name and a number goes by its number.
        set.insert(numbered(constant.id).unwrap_or(name.clone()), value);
    }
    let info = validate(path, module)?;
    let set = process_overrides(module, &info, None, &set);
    let set = set.map_err(|error| {
        let reason = format!(
            "specialisation constants: {}; `constants` of the pass sets them",
            explain(&error)
        );
        FileFault::new(path, None, reason)
    })?;
    *module = set.0.into_owned();
    Ok(())
}

fn name_stage(stage: ShaderStage) -> String {
    format!("{stage:?}").to_lowercase()
}
