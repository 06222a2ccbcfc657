//! Shaders in the languages of engines, translated to modules of naga with the bindings that the
//! suite gives them.
//!
//! Every language but WGSL and WESL goes through SPIR-V. Nothing is taken on trust: each module is
//! validated after each change, and panics of the libraries are caught by the caller.

mod bind;
mod branches;
mod combined;
mod compile;
mod compiler;
mod constants;
mod control_flow;
#[cfg(test)]
mod deep;
mod depth;
mod dialects;
mod entry;
mod flow_reader;
mod includes;
mod language;
mod matrices;
mod members;
mod module;
mod next_block;
mod opengl;
mod packages;
mod places;
mod roots;
mod sections;
mod shader_lab;
mod sources;
mod storage;
mod textures;
mod words;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::filter::PassShader;
use crate::shader::{Shader, guard, try_each};
use crate::{Filter, FilterError, Settings};
use bind::bind;
use compile::list_installed;
use compiler::Compiler;
use module::{OpenModule, check_macros, compile_shader, find_language, read};
use places::check_places;

pub(crate) use language::{Language, SHADER_LAB};
pub(crate) use sources::{MAX_MODULE_BYTES, stays_below};
pub(crate) use textures::check_texture;

/// Function that reads a file of the filter's folder: its path, and its bytes.
pub(crate) type ReadFile<'a> = dyn Fn(&Path) -> Result<(PathBuf, Vec<u8>), FilterError> + 'a;

/// Translates the stages of a pass with the specialisation constants of its first preset.
pub(crate) fn translate(
    filter: &Filter,
    shader: &PassShader,
    read_file: &ReadFile,
) -> Result<Vec<Shader>, FilterError> {
    let stages = shader.stages().into_iter().map(|stage| {
        let (path, bytes) = read_file(&stage.file)?;
        Ok(Stage { stage, path, bytes })
    });
    let stages = stages.collect::<Result<Vec<_>, FilterError>>()?;
    let path = &stages[0].path;
    let task = "translates it";
    let attempt = |compiler| guard(path, task, || translate_with(filter, &stages, compiler));
    let language = find_language(shader, path)?;
    if language.compilers().is_empty() {
        return attempt(None);
    }
    let installed = list_installed(language, shader, path)?;
    let installed = installed
        .into_iter()
        .map(|compiler| (compiler.program, compiler));
    let (mut made, by) = try_each(installed, |compiler| attempt(Some(compiler)))?;
    made[0].compiled_by = Some(by);
    Ok(made)
}

/// A stage of a pass, and the file of its shader.
struct Stage {
    stage: PassShader,
    path: PathBuf,
    bytes: Vec<u8>,
}

/// Translates the stages of a pass by one compiler, if their language needs one.
fn translate_with(
    filter: &Filter,
    stages: &[Stage],
    compiler: Option<&Compiler>,
) -> Result<Vec<Shader>, FilterError> {
    let shader = &stages[0].stage;
    let constants = list_constants(filter, shader, &filter.settings(None)?);
    let compile = |Stage { stage, path, bytes }: &Stage| {
        let compiled = compile_shader(filter, stage, path, bytes, compiler)?;
        let open = read(filter, stage, path, &compiled, &constants)?;
        Ok((compiled, open))
    };
    let made = (stages.iter().map(compile)).collect::<Result<Vec<_>, FilterError>>()?;
    let texts = (stages.iter()).map(|Stage { stage, path, bytes }| (stage, &**path, &bytes[..]));
    check_macros(filter, shader, texts)?;
    let modules: Vec<&OpenModule> = made.iter().map(|(_, open)| open).collect();
    check_places(filter, shader, &stages[0].path, &modules)?;
    // Kept if a parameter changes the module.
    let is_open = (shader.constants.iter()).any(|(_, value)| value.reads_any(&|_| true));
    let bound = stages.iter().zip(made).map(|(stage, (compiled, open))| {
        Ok(Shader {
            compiled: is_open.then(|| Arc::new(compiled)),
            ..bind(filter, &stage.stage, &stage.path, open, &constants)?
        })
    });
    bound.collect()
}

/// Makes a translated shader again, with the specialisation constants of settings.
pub(crate) fn specialise(
    filter: &Filter,
    shader: &PassShader,
    made: &Shader,
    settings: &Settings,
) -> Result<Shader, FilterError> {
    let Some(compiled) = &made.compiled else {
        return Ok(made.clone());
    };
    let specialised = guard(&made.path, "translates it", || {
        let constants = list_constants(filter, shader, settings);
        let open = read(filter, shader, &made.path, compiled, &constants)?;
        let bound = bind(filter, shader, &made.path, open, &constants)?;
        let format_of = |name: &str, format| made.stored_format(name).unwrap_or(format);
        Ok(bound
            .store_as(&format_of)
            .expect("these formats worked with other constants"))
    })?;
    Ok(Shader {
        compiled: made.compiled.clone(),
        compiled_by: made.compiled_by.clone(),
        ..specialised
    })
}

/// Lists the specialisation constants of a pass, by name or number, with the values that settings
/// give them.
pub(crate) fn list_constants(
    filter: &Filter,
    shader: &PassShader,
    settings: &Settings,
) -> Vec<(String, f64)> {
    let numbers = settings.list_numbers(filter);
    let constants = shader.constants.iter();
    constants
        .map(|(name, value)| (name.clone(), value.evaluate(&|name| numbers[name])))
        .collect()
}
