//! Shaders in the languages of engines, translated to modules of naga with the bindings that the suite gives them.
//!
//! Every language but WGSL and WESL goes through SPIR-V. Nothing is taken on trust: each module is validated after each change, and
//! panics of the libraries are caught by the caller.

mod bind;
mod combined;
mod compile;
mod compiler;
#[cfg(test)]
mod deep;
mod entry;
mod formats;
mod includes;
mod language;
mod levels;
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
use crate::shader::{OpenModule, Shader, run_on_large_stack};
use crate::{Filter, FilterError, Settings};
use bind::{bind, check_places};

pub(crate) use language::Language;

/// Largest shader that is read, in bytes.
pub(crate) const MAX_SHADER_BYTES: u64 = compiler::MAX_MODULE_BYTES;

/// Shaders of a pass: its own, and that of its vertex stage if it names one.
pub(crate) struct Translated {
    pub shader: Shader,
    pub vertex: Option<Shader>,
}

/// Translates the shaders of a pass with the specialisation constants of its first preset. `read_file` reads a file of the filter's
/// folder.
pub(crate) fn translate(
    filter: &Filter,
    shader: &PassShader,
    read_file: &dyn Fn(&Path) -> Result<(PathBuf, Vec<u8>), FilterError>,
) -> Result<Translated, FilterError> {
    let (path, bytes) = read_file(&shader.file)?;
    let vertex = shader.vertex_stage();
    let vertex = vertex.map(|stage| Ok::<_, FilterError>((read_file(&stage.file)?, stage)));
    let vertex = vertex.transpose()?;
    guard(&path, || {
        let own = module::read(filter, shader, &path, &bytes)?;
        let vertex = vertex
            .as_ref()
            .map(|((path, bytes), stage)| {
                Ok::<_, FilterError>((module::read(filter, stage, path, bytes)?, path, stage))
            })
            .transpose()?;
        let stages: Vec<&OpenModule> = ([&own].into_iter())
            .chain(vertex.iter().map(|(open, ..)| open))
            .collect();
        check_places(filter, shader, &path, &stages)?;
        let values = filter.settings(None)?.list_numbers(filter);
        let bind_stage = |stage: &PassShader, path: &Path, open: OpenModule| {
            // Kept where a parameter changes the module.
            let is_open = stage
                .constants
                .iter()
                .any(|(_, value)| value.reads_any(&|_| true));
            let kept = is_open.then(|| Arc::new(open.clone()));
            let bound = bind(filter, stage, path, open, &values)?;
            Ok::<_, FilterError>(Shader {
                open: kept,
                ..bound
            })
        };
        Ok(Translated {
            vertex: vertex
                .map(|(open, path, stage)| bind_stage(stage, path, open))
                .transpose()?,
            shader: bind_stage(shader, &path, own)?,
        })
    })
}

/// Makes a translated shader again, with the specialisation constants of settings.
pub(crate) fn specialise(
    filter: &Filter,
    shader: &PassShader,
    made: &Shader,
    settings: &Settings,
) -> Result<Shader, FilterError> {
    let Some(open) = &made.open else {
        return Ok(made.clone());
    };
    let specialised = guard(&made.path, || {
        let values = settings.list_numbers(filter);
        bind(filter, shader, &made.path, (**open).clone(), &values)
    })?;
    Ok(Shader {
        open: made.open.clone(),
        ..specialised
    })
}

/// Does work of naga, whose panics become errors.
fn guard<T: Send>(
    path: &Path,
    work: impl FnOnce() -> Result<T, FilterError> + Send,
) -> Result<T, FilterError> {
    run_on_large_stack(work).unwrap_or_else(|panic| {
        Err(refuse(
            path,
            format!(
                "naga, which translates it, fails on it: {}; write it otherwise, or make it smaller",
                crate::printable::escape_controls(&panic)
            ),
        ))
    })
}

/// Makes an error that names a shader.
fn refuse(path: &Path, reason: String) -> FilterError {
    FilterError::Folder {
        path: path.to_owned(),
        line: None,
        reason,
    }
}

/// Joins the messages of an error and of its causes.
fn explain(error: &dyn std::error::Error) -> String {
    let mut said = error.to_string();
    let mut cause = error.source();
    while let Some(inner) = cause {
        said += &format!(": {inner}");
        cause = inner.source();
    }
    crate::printable::escape_controls(&said.replace('\n', " "))
}
