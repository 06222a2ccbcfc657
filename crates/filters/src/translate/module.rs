//! Modules of naga, read from a shader in any language.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use wgpu::naga::{AddressSpace, Module, ResourceBinding, front};

use super::branches::drop_default_cases;
use super::combined::split_combined_samplers;
use super::compile::{compile, list_installed};
use super::compiler::Compiler;
use super::constants::set_constants;
use super::control_flow::check_control_flow;
use super::depth::read_depth_as_floats;
use super::dialects::check_dialect;
use super::language::{Language, SHADER_LAB};
use super::matrices::find_by_rows;
use super::shader_lab::cut_hlsl;
use super::sources::Sources;
use super::storage::StorageImages;
use super::words::{Place, Words};
use crate::filter::{BindingPlace, PassShader, Stage};
use crate::one_line::explain;
use crate::shader::{parse_wgsl, settle_fall_through, tidy, written_texture};
use crate::{Filter, FilterError, Format};

/// A module that is not validated yet.
#[derive(Default)]
pub(super) struct OpenModule {
    pub module: Module,
    /// Places of variables that were split from others, each with the place of the other.
    pub owners: BTreeMap<BindingPlace, BindingPlace>,
    /// Names and offsets of members that contain the rows of a matrix one after the other.
    pub by_rows: BTreeSet<(String, u32)>,
}

/// Place of the block of push constants. It is a uniform block here, and naga knows push constants
/// only up to 256 bytes.
pub(super) const PUSH_CONSTANTS: ResourceBinding = ResourceBinding {
    group: u32::MAX,
    binding: 0,
};

/// Compiles the bytes of a shader to SPIR-V, or to WGSL if it is WESL. SPIR-V and WGSL stay as they
/// are. A language that `compiler` does not support uses the first of its own.
pub(super) fn compile_shader(
    filter: &Filter,
    shader: &PassShader,
    path: &Path,
    bytes: &[u8],
    compiler: Option<&Compiler>,
) -> Result<Vec<u8>, FilterError> {
    let language = find_language(shader, path)?;
    if language == Language::Spirv {
        return Ok(bytes.to_vec());
    }
    let text = read_text(shader, path, bytes)?;
    if language == Language::Wgsl {
        return Ok(bytes.to_vec());
    }
    let installed = list_installed(language, shader, path)?;
    let is_known =
        |known: &&Compiler| compiler.is_some_and(|compiler| compiler.program == known.program);
    let compiler = installed.iter().copied().find(is_known);
    let compiler = compiler.unwrap_or(installed[0]);
    let sources = Sources::collect(find_folder(filter), shader, &text, language)?;
    check_dialect(&sources, shader, &filter.convention)?;
    compile(&sources, shader, compiler)
}

/// Reads the text of a shader; of ShaderLab, only the HLSL of its pass.
fn read_text(shader: &PassShader, path: &Path, bytes: &[u8]) -> Result<String, FilterError> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let place = error.valid_up_to();
        let reason = format!("is not UTF-8 from byte {place} on; save it as UTF-8");
        FilterError::in_file(path, None, reason)
    })?;
    let ending = shader.file.extension();
    if ending.is_some_and(|ending| ending == SHADER_LAB) {
        cut_hlsl(text, shader.shader_pass.as_ref())
            .map_err(|reason| FilterError::in_file(path, None, reason))
    } else {
        Ok(text.to_owned())
    }
}

fn find_folder(filter: &Filter) -> &Path {
    match filter.lines.path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// Refuses a macro or a condition that no text of a pass names. `stages` are its shaders, each with
/// its path and bytes.
pub(super) fn check_macros<'s>(
    filter: &Filter,
    shader: &PassShader,
    stages: impl Iterator<Item = (&'s PassShader, &'s Path, &'s [u8])>,
) -> Result<(), FilterError> {
    let macros = shader.defines.iter().map(|define| {
        let (name, _) = define.split_once('=').expect("a macro has a value");
        ("defines", name)
    });
    let conditions = shader
        .conditions
        .iter()
        .map(|name| ("conditions", &name[..]));
    let mut idle: Vec<(&str, &str)> = macros.chain(conditions).collect();
    if idle.is_empty() {
        return Ok(());
    }
    for (stage, path, bytes) in stages {
        let text = read_text(stage, path, bytes)?;
        let language = find_language(stage, path)?;
        let sources = Sources::collect(find_folder(filter), stage, &text, language)?;
        for text in sources.texts.values() {
            // Names may be made of parts.
            idle.retain(|(_, name)| !text.contains("##") && !has_word(text, name));
        }
    }
    match idle.first() {
        None => Ok(()),
        Some((key, name)) => Err(FilterError::in_file(
            &filter.lines.path,
            None,
            format!(
                "{key}: {name} changes nothing: neither {} nor a file that it includes names it; allowed: names that occur \
                 there; correct it, or leave it out",
                shader.file.display()
            ),
        )),
    }
}

/// Returns true if a text holds a name as a whole word.
fn has_word(text: &str, name: &str) -> bool {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    text.split(|c| !is_part(c)).any(|word| word == name)
}

/// Reads a compiled shader. `constants` are values of specialisation constants, which SPIR-V gets
/// here.
pub(super) fn read(
    filter: &Filter,
    shader: &PassShader,
    path: &Path,
    compiled: &[u8],
    constants: &[(String, f64)],
) -> Result<OpenModule, FilterError> {
    let wgsl = || {
        let text = String::from_utf8_lossy(compiled);
        let module = parse_wgsl(path, &text)?;
        let module = match read_depth_as_floats(&module, &text) {
            Some(text) => parse_wgsl(path, &text)?,
            None => module,
        };
        Ok::<_, FilterError>(OpenModule {
            module,
            ..OpenModule::default()
        })
    };
    let mut open = match find_language(shader, path)? {
        Language::Wgsl => wgsl()?,
        Language::Wesl => wgsl().map_err(|error| in_compiled(path, &error))?,
        language => {
            let choose = |place, name: &str| find_stored_format(filter, shader, place, name);
            let is_vertex = shader.stage == Stage::Vertex;
            read_spirv(compiled, language, is_vertex, constants, choose)
                .map_err(|reason| FilterError::in_file(path, None, reason))?
        }
    };
    for (_, variable) in open.module.global_variables.iter_mut() {
        if variable.space == AddressSpace::Immediate {
            variable.space = AddressSpace::Uniform;
            variable.binding = Some(PUSH_CONSTANTS);
        }
    }
    Ok(open)
}

/// Finds the language of a shader.
pub(super) fn find_language(shader: &PassShader, path: &Path) -> Result<Language, FilterError> {
    Language::of(&shader.file).map_err(|reason| FilterError::in_file(path, None, reason))
}

/// Finds the format in which filter.toml has the texture that a shader stores to; none for a
/// texture that it does not name.
fn find_stored_format(
    filter: &Filter,
    shader: &PassShader,
    (group, binding): Place,
    name: &str,
) -> Option<Format> {
    let place = BindingPlace::Bound { group, binding };
    let mut bindings = shader.bindings.iter();
    let explained = bindings.find(|binding| match &binding.place {
        BindingPlace::Named(wanted) => wanted == name,
        other => *other == place,
    });
    let texture = explained.and_then(|binding| binding.texture.as_deref());
    let texture = texture.unwrap_or_else(|| written_texture(name));
    match (filter.texture(texture), texture) {
        (Some(declared), _) => Some(declared.format),
        (None, "output") => Some(filter.convention.format_of("output")),
        _ => None,
    }
}

/// Explains an error in WGSL made from WESL, which has other lines than the file.
fn in_compiled(path: &Path, error: &FilterError) -> FilterError {
    let reason = match error {
        FilterError::Folder { reason, .. } => reason.clone(),
        other => other.to_string(),
    };
    let reason = format!("after its imports and conditions: {reason}");
    FilterError::in_file(path, None, reason)
}

/// Reads SPIR-V. `choose` finds the format that filter.toml has for the image at a place and with a
/// name.
fn read_spirv(
    compiled: &[u8],
    language: Language,
    is_vertex: bool,
    constants: &[(String, f64)],
    choose: impl Fn(Place, &str) -> Option<Format>,
) -> Result<OpenModule, String> {
    let mut words = Words::read(compiled)?;
    set_constants(&mut words, constants, is_vertex)?;
    let by_rows = find_by_rows(&words, language);
    let mut owners = split_combined_samplers(&mut words)?;
    let images = StorageImages::prepare(&mut words);
    let is_hlsl = matches!(language, Language::Hlsl | Language::Slang);
    let options = front::spv::Options {
        // Clip space of Vulkan has +y down, HLSL's and Slang's up.
        adjust_coordinate_space: is_vertex && !is_hlsl,
        ..front::spv::Options::default()
    };
    drop_default_cases(&mut words);
    let module = front::spv::parse_u8_slice(&words.write(), &options);
    let mut module = module.map_err(|error| {
        format!(
            "its SPIR-V cannot be read: {}; allowed: the SPIR-V of Vulkan 1.1 shaders without extensions",
            tidy(&explain(&error))
        )
    })?;
    check_control_flow(&words, &options)?;
    settle_fall_through(&mut module);
    images.narrow(&mut module, |place, name, is_open| {
        choose(place, name).filter(|_| is_hlsl || is_open)
    });
    owners.extend(images.owners);
    let bound = |(group, binding): Place| BindingPlace::Bound { group, binding };
    let owners = owners.into_iter();
    Ok(OpenModule {
        module,
        owners: (owners.map(|(split, owner)| (bound(split), bound(owner)))).collect(),
        by_rows,
    })
}
