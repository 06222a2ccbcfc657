//! `shader` of a pass in filter.toml, and the keys that go with it.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use toml::Spanned;

use super::bindings::{BindingEntry, Names, NumberEntry, read_binding, read_level};
use super::file::File;
use crate::filter::{Binding, PassShader, Stage, VertexShader};
use crate::translate::Language;
use crate::{Expression, FilterError};

/// Keys of a pass that are for shaders of its own.
pub(super) struct ShaderKeys<'m> {
    pub file: Option<&'m Spanned<String>>,
    pub entry: Option<&'m str>,
    pub stage: Option<Stage>,
    pub targets: Option<&'m Vec<String>>,
    pub level: Option<&'m NumberEntry>,
    pub vertex: Option<&'m str>,
    pub vertex_shader: Option<&'m Spanned<String>>,
    pub bindings: &'m [Spanned<BindingEntry>],
    pub constants: &'m BTreeMap<String, NumberEntry>,
    pub conditions: &'m [String],
    pub compiler: Option<&'m str>,
}

/// Reads the shader of a pass; none where the pass runs a kernel of the filter's WGSL file.
pub(super) fn read_shader<T>(
    file: &File,
    place: &Spanned<T>,
    keys: &ShaderKeys,
    names: Names,
) -> Result<Option<PassShader>, FilterError> {
    let Some(path) = keys.file else {
        let given = [
            ("stage", keys.stage.is_some()),
            ("targets", keys.targets.is_some()),
            ("level", keys.level.is_some()),
            ("vertex", keys.vertex.is_some()),
            ("vertex_shader", keys.vertex_shader.is_some()),
            ("[[pass.binding]]", !keys.bindings.is_empty()),
            ("constants", !keys.constants.is_empty()),
            ("conditions", !keys.conditions.is_empty()),
            ("compiler", keys.compiler.is_some()),
        ];
        return match given.iter().find(|(_, given)| *given) {
            None => Ok(None),
            Some((key, _)) => Err(file.at(
                place,
                format!("pass: {key} is for a pass with `shader`; add the file of its shader, or leave it out"),
            )),
        };
    };
    let refuse = |reason: String| file.at(path, format!("shader: {reason}"));
    let (relative, language) = read_file(file, "shader", path)?;
    let stage = keys.stage.unwrap_or(match relative.extension() {
        Some(ending) if ending == "frag" => Stage::Fragment,
        _ => Stage::Compute,
    });
    let targets = read_targets(file, place, keys, stage, names)?;
    if language != Language::Wesl && !keys.conditions.is_empty() {
        return Err(refuse(format!(
            "conditions are for WESL; \"{}\" is {}",
            path.get_ref(),
            language.name()
        )));
    }
    let known: Vec<&str> = language.compilers().iter().map(|it| it.program).collect();
    if let Some(compiler) = keys.compiler.filter(|it| !known.contains(it)) {
        let (name, known) = (language.name(), known.join(", "));
        return Err(refuse(match known.is_empty() {
            true => format!("compiler = \"{compiler}\"; {name} needs no compiler; leave it out"),
            false => format!("compiler = \"{compiler}\"; allowed for {name}: {known}"),
        }));
    }
    let vertex = read_vertex(file, place, keys, stage, &relative)?;
    let entry = keys.entry.unwrap_or("main");
    // Names are words of a compiler's command line.
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let is_name = |name: &&str| name.starts_with(is_part) && name.chars().all(is_part);
    let corner = vertex.as_ref().map(|vertex| vertex.entry.clone());
    let mut names_of_code = (keys.conditions.iter().map(String::as_str))
        .chain([entry])
        .chain(corner.as_deref());
    if let Some(name) = names_of_code.find(|name| !is_name(name)) {
        return Err(refuse(format!(
            "\"{name}\" is no name of an entry point or a condition; allowed: letters, digits and _"
        )));
    }
    let mut bindings = Vec::<Binding>::new();
    file.check_number("pass.binding", keys.bindings)?;
    for spanned in keys.bindings {
        let binding = read_binding(file, spanned, names)?;
        if bindings.iter().any(|known| known.place == binding.place) {
            return Err(file.at(
                spanned,
                format!("binding: {} is explained twice", binding.place),
            ));
        }
        bindings.push(binding);
    }
    Ok(Some(PassShader {
        file: relative,
        entry: entry.to_owned(),
        stage,
        targets,
        level: read_level(file, place, keys.level, names)?,
        vertex,
        bindings,
        constants: read_constants(file, place, keys.constants, names)?,
        conditions: keys.conditions.to_vec(),
        compiler: keys.compiler.map(str::to_owned),
    }))
}

/// Reads the name of a file of a shader.
fn read_file(
    file: &File,
    key: &str,
    path: &Spanned<String>,
) -> Result<(PathBuf, Language), FilterError> {
    let refuse = |reason: String| file.at(path, format!("{key}: {reason}"));
    let relative = read_relative(path.get_ref()).map_err(refuse)?;
    let language = Language::of(&relative).map_err(refuse)?;
    file.check_line(path, key, path.get_ref())?;
    Ok((relative, language))
}

/// Reads the vertex stage: an entry point of the shader's own file, or of another one.
fn read_vertex<T>(
    file: &File,
    place: &Spanned<T>,
    keys: &ShaderKeys,
    stage: Stage,
    shader: &Path,
) -> Result<Option<VertexShader>, FilterError> {
    if keys.vertex.is_none() && keys.vertex_shader.is_none() {
        return Ok(None);
    }
    if stage != Stage::Fragment {
        let reason =
            "vertex and vertex_shader are for stage = \"fragment\"; a compute shader draws nothing";
        return Err(file.at(place, reason.into()));
    }
    let path = keys
        .vertex_shader
        .map(|path| read_file(file, "vertex_shader", path));
    let path = path.transpose()?;
    Ok(Some(VertexShader {
        file: path.map_or(shader.to_owned(), |(path, _)| path),
        entry: keys.vertex.unwrap_or("main").to_owned(),
    }))
}

/// Reads values of specialisation constants: numbers, and expressions of parameters.
fn read_constants<T>(
    file: &File,
    place: &Spanned<T>,
    constants: &BTreeMap<String, NumberEntry>,
    names: Names,
) -> Result<Vec<(String, Expression)>, FilterError> {
    let is_known = |name: &str| names.is_setting(name);
    let read = |(name, entry): (&String, &NumberEntry)| {
        let value = match entry {
            NumberEntry::Number(number) if number.is_finite() => Ok(Expression::Number(*number)),
            NumberEntry::Number(number) => Err(format!("{name} = {number}; allowed: finite")),
            NumberEntry::Text(text) => Expression::parse(text, &is_known).map_err(|reason| {
                format!(
                    "{name} = \"{text}\" {reason}; allowed: numbers, parameters, and values of [convention]"
                )
            }),
        };
        let value = value.map_err(|reason| file.at(place, format!("constants: {reason}")))?;
        Ok((name.clone(), value))
    };
    constants.iter().map(read).collect()
}

/// Reads a path that stays in the filter's folder.
fn read_relative(text: &str) -> Result<PathBuf, String> {
    let path = Path::new(text);
    let stays = |part: Component| matches!(part, Component::Normal(_) | Component::CurDir);
    match !text.is_empty() && path.components().all(stays) {
        true => Ok(path.to_owned()),
        false => Err(format!(
            "\"{text}\" is no path within the filter's folder; allowed: a path without .. that begins with no /"
        )),
    }
}

/// Reads the render targets of a fragment shader: the picture if none are named.
fn read_targets<T>(
    file: &File,
    place: &Spanned<T>,
    keys: &ShaderKeys,
    stage: Stage,
    names: Names,
) -> Result<Vec<String>, FilterError> {
    let targets = match (stage, keys.targets) {
        (Stage::Compute | Stage::Vertex, None) => {
            return match keys.level {
                None => Ok(Vec::new()),
                Some(_) => {
                    let reason = "level of a pass is for stage = \"fragment\"; a compute shader writes the `level` of its \
                                  [[pass.binding]]";
                    Err(file.at(place, reason.into()))
                }
            };
        }
        (Stage::Compute | Stage::Vertex, Some(_)) => {
            let reason =
                "targets are for stage = \"fragment\"; a compute shader writes storage textures";
            return Err(file.at(place, reason.into()));
        }
        (Stage::Fragment, None) => return Ok(vec!["output".to_owned()]),
        (Stage::Fragment, Some(targets)) => targets,
    };
    let is_declared = |name: &String| (names.textures.iter()).any(|texture| texture.name == *name);
    let unknown = (targets.iter()).find(|name| *name != "output" && !is_declared(name));
    if let Some(unknown) = unknown {
        return Err(file.at(
            place,
            format!("targets: \"{unknown}\" is neither output nor a declared texture"),
        ));
    }
    let twice = (targets.iter().enumerate()).any(|(index, name)| targets[..index].contains(name));
    if targets.is_empty() || targets.len() > 8 || twice {
        return Err(file.at(
            place,
            "targets: allowed: from one to eight different textures, in the order of the shader's locations".into(),
        ));
    }
    Ok(targets.clone())
}
