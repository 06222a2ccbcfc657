//! `shader` of a pass in filter.toml, and the keys that go with it.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use serde::Deserialize;
use shader_import::{LabPass, Language, SHADER_LAB, ShaderFile, Stage};
use toml::Spanned;

use super::bindings::{BindingEntry, read_bindings};
use super::defines::read_defines;
use super::file::File;
use super::number::NumberEntry;
use crate::filter::{PassShader, VertexShader};
use crate::{Count, Filter, FilterError};

/// `[[pass]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PassEntry {
    pub entry: Option<String>,
    pub over: Option<String>,
    #[serde(default)]
    pub workgroup_per_texel: bool,
    pub repeat: Option<Count>,
    pub shader: Option<Spanned<String>>,
    pub shader_pass: Option<LabPass>,
    pub stage: Option<Stage>,
    pub targets: Option<Vec<String>>,
    pub level: Option<NumberEntry>,
    pub vertex: Option<String>,
    pub vertex_shader: Option<Spanned<String>>,
    #[serde(default)]
    pub binding: Vec<Spanned<BindingEntry>>,
    #[serde(default)]
    pub constants: BTreeMap<String, NumberEntry>,
    #[serde(default)]
    pub conditions: Vec<String>,
    #[serde(default)]
    pub defines: BTreeMap<String, toml::Value>,
    pub compiler: Option<String>,
}

/// Reads the shader of a pass; none if the pass runs a kernel of the filter's WGSL file.
pub(super) fn read_shader(
    file: &File,
    pass: &Spanned<PassEntry>,
    filter: &Filter,
) -> Result<Option<PassShader>, FilterError> {
    let keys = pass.get_ref();
    let Some(path) = &keys.shader else {
        return refuse_keys(keys)
            .map(|()| None)
            .map_err(|reason| file.at(pass, reason));
    };
    let refuse = |reason: String| file.at(path, format!("shader: {reason}"));
    let (relative, language) = read_file(file, "shader", path)?;
    let stage = keys.stage.unwrap_or(match relative.extension() {
        Some(ending) if ending == "frag" => Stage::Fragment,
        _ => Stage::Compute,
    });
    let targets = read_targets(keys, stage, filter).map_err(|reason| file.at(pass, reason))?;
    check_compiler(keys, language, path.get_ref()).map_err(refuse)?;
    let vertex = read_vertex(file, pass, stage, &relative)?;
    let entry = keys.entry.as_deref().unwrap_or("main");
    let corner = vertex.as_ref().map(|vertex| &vertex.entry[..]);
    let conditions = keys.conditions.iter().map(String::as_str);
    check_names(conditions.chain([entry]).chain(corner)).map_err(refuse)?;
    let level = keys.level.as_ref().map(|level| filter.read_level(level));
    let constants = keys.constants.iter().map(|(name, value)| {
        let value = filter.read_constant(value);
        let value = value.map_err(|reason| format!("constants: {name} = {reason}"))?;
        Ok((name.clone(), value))
    });
    let constants: Result<_, String> = constants.collect();
    let defines = read_defines(&keys.defines, language);
    Ok(Some(PassShader {
        file: ShaderFile {
            path: relative,
            shader_pass: keys.shader_pass.clone(),
            entry: entry.to_owned(),
            stage,
            conditions: keys.conditions.clone(),
            defines: defines.map_err(|reason| file.at(pass, format!("defines: {reason}")))?,
            compiler: keys.compiler.clone(),
        },
        targets,
        bindings: read_bindings(file, &keys.binding, filter)?,
        level: (level.transpose()).map_err(|reason| file.at(pass, format!("level = {reason}")))?,
        vertex,
        constants: constants.map_err(|reason| file.at(pass, reason))?,
    }))
}

/// Refuses keys that are for a shader of the pass's own.
fn refuse_keys(keys: &PassEntry) -> Result<(), String> {
    let given = [
        ("shader_pass", keys.shader_pass.is_some()),
        ("stage", keys.stage.is_some()),
        ("targets", keys.targets.is_some()),
        ("level", keys.level.is_some()),
        ("vertex", keys.vertex.is_some()),
        ("vertex_shader", keys.vertex_shader.is_some()),
        ("[[pass.binding]]", !keys.binding.is_empty()),
        ("constants", !keys.constants.is_empty()),
        ("conditions", !keys.conditions.is_empty()),
        ("defines", !keys.defines.is_empty()),
        ("compiler", keys.compiler.is_some()),
    ];
    match given.iter().find(|(_, given)| *given) {
        None => Ok(()),
        Some((key, _)) => Err(format!(
            "pass: {key} is for a pass with `shader`; add the file of its shader, or leave it out"
        )),
    }
}

/// Refuses conditions and a compiler that the language does not have.
fn check_compiler(keys: &PassEntry, language: Language, path: &str) -> Result<(), String> {
    let name = language.name();
    if language != Language::Wesl && !keys.conditions.is_empty() {
        return Err(format!("conditions are for WESL; \"{path}\" is {name}"));
    }
    if keys.shader_pass.is_some() && !path.ends_with(&format!(".{SHADER_LAB}")) {
        return Err(format!(
            "shader_pass is for a .{SHADER_LAB} file of Unity; \"{path}\" is none"
        ));
    }
    let known: Vec<&str> = language
        .compilers()
        .iter()
        .map(|compiler| compiler.program)
        .collect();
    match keys.compiler.as_deref() {
        Some(compiler) if known.is_empty() => Err(format!(
            "compiler = \"{compiler}\"; {name} needs no compiler; leave it out"
        )),
        Some(compiler) if !known.contains(&compiler) => Err(format!(
            "compiler = \"{compiler}\"; allowed for {name}: {}",
            known.join(", ")
        )),
        _ => Ok(()),
    }
}

/// Refuses names of entry points and conditions that are not words, because a compiler gets them on
/// its command line.
fn check_names<'n>(mut names: impl Iterator<Item = &'n str>) -> Result<(), String> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let is_name = |name: &str| name.starts_with(is_part) && name.chars().all(is_part);
    match names.find(|name| !is_name(name)) {
        None => Ok(()),
        Some(name) => Err(format!(
            "\"{name}\" is no name of an entry point or a condition; allowed: letters, digits and _"
        )),
    }
}

/// Reads the name of a shader's file, which must be in the filter's folder.
fn read_file(
    file: &File,
    key: &str,
    spanned: &Spanned<String>,
) -> Result<(PathBuf, Language), FilterError> {
    let refuse = |reason: String| file.at(spanned, format!("{key}: {reason}"));
    let path = Path::new(spanned.get_ref());
    let stays = |part: Component| matches!(part, Component::Normal(_) | Component::CurDir);
    if path.as_os_str().is_empty() || !path.components().all(stays) {
        return Err(refuse(format!(
            "\"{}\" is no path within the filter's folder; allowed: a path without .. that begins with no /",
            spanned.get_ref()
        )));
    }
    let language = Language::of(path).map_err(refuse)?;
    file.check_line(spanned, key, spanned.get_ref())?;
    Ok((path.to_owned(), language))
}

/// Reads the vertex stage: an entry point of the shader's own file, or of another one.
fn read_vertex(
    file: &File,
    pass: &Spanned<PassEntry>,
    stage: Stage,
    shader: &Path,
) -> Result<Option<VertexShader>, FilterError> {
    let PassEntry {
        vertex,
        vertex_shader,
        ..
    } = pass.get_ref();
    if vertex.is_none() && vertex_shader.is_none() {
        return Ok(None);
    }
    if stage != Stage::Fragment {
        let reason =
            "vertex and vertex_shader are for stage = \"fragment\"; a compute shader draws nothing";
        return Err(file.at(pass, reason.into()));
    }
    let vertex_file = vertex_shader.as_ref();
    let vertex_file = vertex_file.map(|path| read_file(file, "vertex_shader", path));
    Ok(Some(VertexShader {
        path: vertex_file
            .transpose()?
            .map_or(shader.to_owned(), |(path, _)| path),
        entry: vertex.clone().unwrap_or_else(|| "main".to_owned()),
    }))
}

/// Reads the render targets of a fragment shader: the picture if none are named.
fn read_targets(keys: &PassEntry, stage: Stage, filter: &Filter) -> Result<Vec<String>, String> {
    let targets = match (stage, &keys.targets) {
        (Stage::Fragment, None) => return Ok(vec!["output".to_owned()]),
        (Stage::Fragment, Some(targets)) => targets,
        (_, None) if keys.level.is_none() => return Ok(Vec::new()),
        (_, None) => {
            return Err(
                "level of a pass is for stage = \"fragment\"; a compute shader writes the `level` of its [[pass.binding]]"
                    .into(),
            );
        }
        (_, Some(_)) => {
            return Err(
                "targets are for stage = \"fragment\"; a compute shader writes storage textures"
                    .into(),
            );
        }
    };
    let is_known = |name: &str| name == "output" || filter.texture(name).is_some();
    if let Some(unknown) = targets.iter().find(|name| !is_known(name)) {
        return Err(format!(
            "targets: \"{unknown}\" is neither output nor a declared texture"
        ));
    }
    let twice = (targets.iter().enumerate()).any(|(index, name)| targets[..index].contains(name));
    if targets.is_empty() || targets.len() > 8 || twice {
        return Err(
            "targets: allowed: from one to eight different textures, in the order of the shader's locations"
                .into(),
        );
    }
    Ok(targets.clone())
}
