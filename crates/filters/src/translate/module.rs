//! Modules of naga, read from a shader in any language.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use wgpu::naga::{AddressSpace, Module, ResourceBinding, front};

use super::combined::split_combined_samplers;
use super::compile::{compile, list_installed};
use super::constants::set_constants;
use super::formats::give_formats;
use super::levels::name_levels;
use super::matrices::find_by_rows;
use super::storage::{narrow_storage_access, split_images};
use super::words::{Place, Words};
use super::{Language, explain, refuse};
use crate::filter::{BindingPlace, PassShader, Stage};
use crate::shader::{parse_wgsl, tidy, written_texture};
use crate::{Filter, FilterError, Format};

/// A module that is not validated yet.
pub(super) struct OpenModule {
    pub module: Module,
    /// Places of variables that were split from others, each with the place of the other.
    pub owners: BTreeMap<Place, Place>,
    /// Names and offsets of members that hold the rows of a matrix one after the other.
    pub by_rows: BTreeSet<(String, u32)>,
}

/// Place of the block of push constants. It is a uniform block here, and naga knows push constants only up to 256 bytes.
pub(super) const PUSH_CONSTANTS: ResourceBinding = ResourceBinding {
    group: u32::MAX,
    binding: 0,
};

/// Compiles the bytes of a shader to SPIR-V, or to WGSL if it is WESL. SPIR-V and WGSL stay as they are. A language that `compiler`
/// does not know takes the first of its own.
pub(super) fn compile_shader(
    filter: &Filter,
    shader: &PassShader,
    path: &Path,
    bytes: &[u8],
    compiler: Option<&str>,
) -> Result<Vec<u8>, FilterError> {
    let language = Language::of(&shader.file).map_err(|reason| refuse(path, reason))?;
    if language == Language::Spirv {
        return Ok(bytes.to_vec());
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let place = error.valid_up_to();
        refuse(
            path,
            format!("is not UTF-8 from byte {place} on; save it as UTF-8"),
        )
    })?;
    let folder = match filter.lines.path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    if language == Language::Wgsl {
        return Ok(bytes.to_vec());
    }
    let installed = list_installed(language, shader, path)?;
    let compiler = compiler.filter(|compiler| installed.contains(compiler));
    let compiler = compiler.unwrap_or(installed[0]);
    let text = match language {
        Language::Glsl => without_stage_line(text),
        _ => text.to_owned(),
    };
    compile(folder, &text, language, shader, compiler)
}

/// Reads a compiled shader. `constants` are values of specialisation constants, which SPIR-V gets here.
pub(super) fn read(
    filter: &Filter,
    shader: &PassShader,
    path: &Path,
    compiled: &[u8],
    constants: &[(String, f64)],
) -> Result<OpenModule, FilterError> {
    let language = Language::of(&shader.file).map_err(|reason| refuse(path, reason))?;
    let from_wgsl = |module| OpenModule {
        module,
        owners: BTreeMap::new(),
        by_rows: BTreeSet::new(),
    };
    let wgsl = || String::from_utf8_lossy(compiled);
    let mut open = match language {
        Language::Wgsl => parse_wgsl(path, &wgsl()).map(from_wgsl),
        Language::Wesl => parse_wgsl(path, &wgsl())
            .map(from_wgsl)
            .map_err(|error| in_compiled(path, &error)),
        Language::Spirv | Language::Glsl | Language::Slang | Language::Hlsl => {
            let mut words = Words::read(compiled).map_err(|reason| refuse(path, reason))?;
            let is_vertex = shader.stage == Stage::Vertex;
            set_constants(&mut words, constants, is_vertex)
                .map_err(|reason| refuse(path, reason))?;
            let unsaid = matches!(language, Language::Hlsl | Language::Slang);
            let stored = |place, name: &str| find_stored_format(filter, shader, place, name);
            let by_rows = find_by_rows(&words, language);
            let give = |words: &mut Words| give_formats(words, unsaid, &stored);
            // Clip space of Vulkan has +y down, that of HLSL and of Slang up.
            let (module, owners) = read_spirv(path, words, is_vertex && !unsaid, &give)?;
            Ok(OpenModule {
                module,
                owners,
                by_rows,
            })
        }
    }?;
    for (_, variable) in open.module.global_variables.iter_mut() {
        if variable.space == AddressSpace::Immediate {
            variable.space = AddressSpace::Uniform;
            variable.binding = Some(PUSH_CONSTANTS);
        }
    }
    Ok(open)
}

/// Finds the format in which filter.toml has the texture that a shader stores to; none for a texture that it does not name.
fn find_stored_format(
    filter: &Filter,
    shader: &PassShader,
    (group, binding): Place,
    name: &str,
) -> Option<Format> {
    let place = BindingPlace::Bound { group, binding };
    let mut bindings = shader.bindings.iter();
    let explained = bindings.find(|it| match &it.place {
        BindingPlace::Named(wanted) => wanted == name,
        other => *other == place,
    });
    let texture = explained.and_then(|binding| binding.texture.as_deref());
    let texture = texture.unwrap_or_else(|| written_texture(name));
    let declared = filter.textures.iter().find(|it| it.name == texture);
    match (declared, texture) {
        (Some(declared), _) => Some(declared.format),
        (None, "output") => Some(
            filter
                .convention
                .output_format
                .unwrap_or(Format::Rgba32Float),
        ),
        _ => None,
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

fn read_spirv(
    path: &Path,
    mut words: Words,
    is_flipped: bool,
    give_formats: &dyn Fn(&mut Words),
) -> Result<(Module, BTreeMap<Place, Place>), FilterError> {
    let mut owners = split_combined_samplers(&mut words).map_err(|reason| refuse(path, reason))?;
    owners.extend(split_images(&mut words));
    narrow_storage_access(&mut words);
    name_levels(&mut words);
    give_formats(&mut words);
    let options = front::spv::Options {
        adjust_coordinate_space: is_flipped,
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
    Ok((module, owners))
}
