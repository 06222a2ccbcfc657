//! Shaders in the languages of engines, translated to modules of naga with the bindings that the suite gives them.
//!
//! Every language but WGSL and WESL goes through SPIR-V. Nothing is taken on trust: each module is validated after each change, and
//! panics of the libraries are caught by the caller.

mod bind;
mod closed;
mod combined;
mod compile;
mod compiler;
mod constants;
#[cfg(test)]
mod deep;
mod entry;
mod includes;
mod language;
mod matrices;
mod members;
mod module;
mod packages;
mod sources;
mod storage;
mod textures;
mod words;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::filter::PassShader;
use crate::printable::escape_controls;
use crate::shader::{Shader, run_on_large_stack, try_each};
use crate::{Filter, FilterError, Settings};
use bind::{bind, check_places};
use compile::list_installed;
use compiler::Compiler;
use module::{OpenModule, compile_shader, find_language, read};

pub(crate) use language::Language;
pub(crate) use sources::{MAX_MODULE_BYTES, stays_below};
pub(crate) use textures::check_texture;

/// Function that reads a file of the filter's folder: its path, and its bytes.
pub(crate) type ReadFile<'a> = dyn Fn(&Path) -> Result<(PathBuf, Vec<u8>), FilterError> + 'a;

/// Shaders of a pass: its own, and that of its vertex stage if it names one.
pub(crate) struct Translated {
    pub shader: Shader,
    pub vertex: Option<Shader>,
}

/// Translates the shaders of a pass with the specialisation constants of its first preset.
pub(crate) fn translate(
    filter: &Filter,
    shader: &PassShader,
    read_file: &ReadFile,
) -> Result<Translated, FilterError> {
    let (path, bytes) = read_file(&shader.file)?;
    let vertex = shader.vertex_stage();
    let vertex = vertex.map(|stage| Ok::<_, FilterError>((read_file(&stage.file)?, stage)));
    let vertex = vertex.transpose()?;
    let own = (path.as_path(), &bytes[..]);
    let vertex = vertex.as_ref();
    let vertex = vertex.map(|((path, bytes), stage)| ((path.as_path(), &bytes[..]), stage));
    let attempt = |compiler| {
        guard(&path, || {
            translate_with(filter, (shader, own), vertex, compiler)
        })
    };
    let language = find_language(shader, &path)?;
    if language.compilers().is_empty() {
        return attempt(None);
    }
    let installed = list_installed(language, shader, &path)?;
    let (mut made, compiled_by) =
        try_each(installed.iter().map(|it| (it.program, *it)), |compiler| {
            attempt(Some(compiler))
        })?;
    made.shader.compiled_by = Some(compiled_by);
    Ok(made)
}

/// Path and bytes of a shader.
type File<'f> = (&'f Path, &'f [u8]);

/// Translates the shaders of a pass by one compiler, if their language needs one.
fn translate_with(
    filter: &Filter,
    (shader, (path, bytes)): (&PassShader, File),
    vertex: Option<(File, &PassShader)>,
    compiler: Option<&Compiler>,
) -> Result<Translated, FilterError> {
    let constants = list_constants(filter, shader, &filter.settings(None)?);
    let compile = |stage: &PassShader, (path, bytes): File| {
        let compiled = compile_shader(filter, stage, path, bytes, compiler)?;
        let open = read(filter, stage, path, &compiled, &constants)?;
        Ok::<_, FilterError>((compiled, open))
    };
    let own = compile(shader, (path, bytes))?;
    let vertex = vertex
        .map(|(file, stage)| Ok((compile(stage, file)?, file.0, stage)))
        .transpose()?;
    let corners = vertex.as_ref().map(|((_, open), ..)| open);
    let stages: Vec<&OpenModule> = [&own.1].into_iter().chain(corners).collect();
    check_places(filter, shader, path, &stages)?;
    // Kept where a parameter changes the module.
    let is_open = (shader.constants.iter()).any(|(_, value)| value.reads_any(&|_| true));
    let bind_stage = |(compiled, open), path: &Path, stage: &PassShader| {
        let bound = bind(filter, stage, path, open, &constants)?;
        Ok::<_, FilterError>(Shader {
            compiled: is_open.then(|| Arc::new(compiled)),
            ..bound
        })
    };
    let vertex = vertex.map(|(made, path, stage)| bind_stage(made, path, stage));
    Ok(Translated {
        vertex: vertex.transpose()?,
        shader: bind_stage(own, path, shader)?,
    })
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
    let specialised = guard(&made.path, || {
        let constants = list_constants(filter, shader, settings);
        let open = read(filter, shader, &made.path, compiled, &constants)?;
        let bound = bind(filter, shader, &made.path, open, &constants)?;
        let kept = |name: &str, format| made.stored_format(name).unwrap_or(format);
        Ok(bound
            .store_as(&kept)
            .expect("it stored so with other constants"))
    })?;
    Ok(Shader {
        compiled: made.compiled.clone(),
        compiled_by: made.compiled_by.clone(),
        ..specialised
    })
}

/// Lists the specialisation constants of a pass, by name or number, with the values that settings give them.
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

/// Does work of naga, whose panics become errors.
fn guard<T: Send>(
    path: &Path,
    work: impl FnOnce() -> Result<T, FilterError> + Send,
) -> Result<T, FilterError> {
    run_on_large_stack(work).unwrap_or_else(|panic| {
        let panic = escape_controls(&panic);
        Err(FilterError::in_file(
            path,
            None,
            format!(
                "naga, which translates it, fails on it: {panic}; write it otherwise, or make it smaller"
            ),
        ))
    })
}
