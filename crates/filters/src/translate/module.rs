//! Modules of naga, read from a shader in any language.

use std::collections::BTreeMap;
use std::path::Path;

use wgpu::naga::{Module, front};

use super::combined::{Place, split_combined_samplers};
use super::storage::narrow_storage_access;
use super::words::Words;
use super::{Language, compiler, explain, refuse};
use crate::FilterError;
use crate::filter::PassShader;
use crate::shader::{parse_wgsl, tidy};

/// A module that is not validated yet.
pub(super) struct Read {
    pub module: Module,
    /// Places of samplers that were split from textures, each with the place of its texture.
    pub samplers: BTreeMap<Place, Place>,
}

/// Reads the bytes of a shader.
pub(super) fn read(shader: &PassShader, path: &Path, bytes: &[u8]) -> Result<Read, FilterError> {
    let language = Language::of(&shader.file).map_err(|reason| refuse(path, reason))?;
    if language == Language::Spirv {
        return read_spirv(path, bytes);
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let place = error.valid_up_to();
        refuse(
            path,
            format!("is not UTF-8 from byte {place} on; save it as UTF-8"),
        )
    })?;
    let read = |module| Read {
        module,
        samplers: BTreeMap::new(),
    };
    match language {
        Language::Wgsl => parse_wgsl(path, text).map(read),
        Language::Wesl => {
            let wgsl = compiler::compile(path, text, language, shader)?;
            let wgsl = String::from_utf8_lossy(&wgsl);
            parse_wgsl(path, &wgsl)
                .map(read)
                .map_err(|error| in_compiled(path, &error))
        }
        Language::Glsl => compile(shader, path, &without_stage_line(text), language),
        Language::Spirv | Language::Slang | Language::Hlsl => compile(shader, path, text, language),
    }
}

/// Explains an error in the WGSL that WESL became, whose lines are not those of the file.
fn in_compiled(path: &Path, error: &FilterError) -> FilterError {
    let reason = match error {
        FilterError::Kernels { reason, .. } | FilterError::Folder { reason, .. } => reason.clone(),
        other => other.to_string(),
    };
    refuse(path, format!("after its imports and conditions: {reason}"))
}

fn compile(
    shader: &PassShader,
    path: &Path,
    text: &str,
    language: Language,
) -> Result<Read, FilterError> {
    let module = compiler::compile(path, text, language, shader)?;
    read_spirv(path, &module)
}

/// Blanks the line `#[compute]` that Godot puts before its shaders; the numbers of lines hold.
fn without_stage_line(text: &str) -> String {
    let mark = ["#[compute]", "#[fragment]"];
    match mark
        .iter()
        .find(|mark| text.trim_start().starts_with(**mark))
    {
        Some(mark) => text.replacen(mark, "", 1),
        None => text.to_owned(),
    }
}

fn read_spirv(path: &Path, bytes: &[u8]) -> Result<Read, FilterError> {
    let mut words = Words::read(bytes).map_err(|reason| refuse(path, reason))?;
    let samplers = split_combined_samplers(&mut words).map_err(|reason| refuse(path, reason))?;
    narrow_storage_access(&mut words);
    let options = front::spv::Options {
        adjust_coordinate_space: false,
        ..front::spv::Options::default()
    };
    let module = front::spv::parse_u8_slice(&words.write(), &options).map_err(|error| {
        refuse(
            path,
            format!(
                "its SPIR-V cannot be read: {}; allowed: the SPIR-V of Vulkan 1.1 shaders without extensions",
                tidy(&explain(&error))
            ),
        )
    })?;
    Ok(Read { module, samplers })
}
