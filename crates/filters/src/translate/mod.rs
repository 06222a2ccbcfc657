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
mod members;
mod module;
mod packages;
mod sources;
mod storage;
mod textures;
mod words;

use std::path::Path;

use crate::filter::PassShader;
use crate::shader::{Shader, run_on_large_stack};
use crate::{Filter, FilterError};

pub(crate) use language::Language;

/// Largest shader that is read, in bytes.
pub(crate) const MAX_SHADER_BYTES: u64 = compiler::MAX_MODULE_BYTES;

/// Translates the shader of a pass. `bytes` are those of the file at `path`.
pub(crate) fn translate(
    filter: &Filter,
    shader: &PassShader,
    path: &Path,
    bytes: &[u8],
) -> Result<Shader, FilterError> {
    let translated = run_on_large_stack(|| {
        let module = module::read(filter, shader, path, bytes)?;
        bind::bind(filter, shader, path, module)
    });
    translated.unwrap_or_else(|panic| {
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
