//! `shader` and `[[pass.binding]]` of filter.toml.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use serde::Deserialize;
use toml::Spanned;

use super::file::{File, MAX_ENTRIES};
use crate::filter::{
    Binding, BindingPlace, CONVENTION_VALUES, Expression, FRAME_VALUES, PassShader, SamplerFilter,
    Sampling, Stage, Wrap,
};
use crate::translate::Language;
use crate::{Convention, FilterError, Parameter, Texture};

/// `[[pass.binding]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BindingEntry {
    #[serde(default, alias = "set")]
    group: u32,
    binding: Option<u32>,
    name: Option<String>,
    #[serde(default)]
    push_constants: bool,
    #[serde(default)]
    globals: bool,
    texture: Option<String>,
    sampler: Option<SamplerFilter>,
    wrap: Option<Wrap>,
    #[serde(default)]
    values: BTreeMap<String, ValueEntry>,
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "a value is a number, a text with an expression, or a list of these"
)]
enum ValueEntry {
    One(NumberEntry),
    Several(Vec<NumberEntry>),
}

#[derive(Deserialize)]
#[serde(untagged, expecting = "a number or a text with an expression")]
enum NumberEntry {
    Number(f64),
    Text(String),
}

/// Keys of a pass that are for shaders of its own.
pub(super) struct ShaderKeys<'m> {
    pub file: Option<&'m Spanned<String>>,
    pub entry: Option<&'m str>,
    pub stage: Option<Stage>,
    pub targets: Option<&'m Vec<String>>,
    pub bindings: &'m [Spanned<BindingEntry>],
    pub constants: &'m BTreeMap<String, f64>,
    pub conditions: &'m [String],
}

/// Names that values and targets may have.
#[derive(Clone, Copy)]
pub(super) struct Names<'m> {
    pub textures: &'m [Texture],
    pub parameters: &'m [Parameter],
    pub convention: &'m Convention,
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
            ("[[pass.binding]]", !keys.bindings.is_empty()),
            ("constants", !keys.constants.is_empty()),
            ("conditions", !keys.conditions.is_empty()),
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
    let relative = read_relative(path.get_ref()).map_err(refuse)?;
    let language = Language::of(&relative).map_err(refuse)?;
    file.check_line(path, "shader", path.get_ref())?;
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
    let entry = keys.entry.unwrap_or("main");
    // Names are words of a compiler's command line.
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let is_name = |name: &&str| name.starts_with(is_part) && name.chars().all(is_part);
    let mut names_of_code = (keys.conditions.iter().map(String::as_str)).chain([entry]);
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
        bindings,
        constants: keys.constants.clone().into_iter().collect(),
        conditions: keys.conditions.to_vec(),
    }))
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
        (Stage::Compute, None) => return Ok(Vec::new()),
        (Stage::Compute, Some(_)) => {
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

fn read_binding(
    file: &File,
    spanned: &Spanned<BindingEntry>,
    names: Names,
) -> Result<Binding, FilterError> {
    let entry = spanned.get_ref();
    let refuse = |reason: String| file.at(spanned, format!("binding: {reason}"));
    let mut places = [
        entry.binding.map(|binding| BindingPlace::Bound {
            group: entry.group,
            binding,
        }),
        entry.name.clone().map(BindingPlace::Named),
        entry.push_constants.then_some(BindingPlace::PushConstants),
        entry.globals.then_some(BindingPlace::Globals),
    ]
    .into_iter()
    .flatten();
    let (Some(place), None) = (places.next(), places.next()) else {
        return Err(refuse(
            "needs one of `binding` with its number in the group, `name` of its variable, `push_constants = true` and \
             `globals = true`"
                .into(),
        ));
    };
    if let Some(name) = &entry.name {
        file.check_line(spanned, "binding: name", name)?;
    }
    if entry.values.len() > MAX_ENTRIES {
        return Err(refuse(format!("has more than {MAX_ENTRIES} values")));
    }
    let is_known = |name: &str| is_value(name, names);
    let read_number = |member: &str, number: &NumberEntry| match number {
        NumberEntry::Number(number) if number.is_finite() => Ok(Expression::Number(*number)),
        NumberEntry::Number(number) => Err(refuse(format!("{member} = {number}; allowed: finite"))),
        NumberEntry::Text(text) => Expression::parse(text, &is_known).map_err(|reason| {
            refuse(format!(
                "{member} = \"{text}\" {reason}; known names: {}",
                list_values(names)
            ))
        }),
    };
    let mut values = Vec::new();
    for (member, given) in &entry.values {
        let numbers = match given {
            ValueEntry::One(number) => vec![read_number(member, number)?],
            ValueEntry::Several(numbers) => (numbers.iter())
                .map(|number| read_number(member, number))
                .collect::<Result<_, _>>()?,
        };
        values.push((member.clone(), numbers));
    }
    Ok(Binding {
        place,
        texture: entry.texture.clone(),
        sampling: Sampling {
            filter: entry.sampler.unwrap_or_default(),
            wrap: entry.wrap.unwrap_or_default(),
        },
        values,
        line: file.line(spanned.span().start),
    })
}

fn is_value(name: &str, names: Names) -> bool {
    (names.parameters.iter()).any(|parameter| parameter.name == name)
        || FRAME_VALUES.iter().any(|(known, _)| *known == name)
        || names.convention.value(name).is_some()
}

fn list_values(names: Names) -> String {
    let parameters = names.parameters.iter().map(|parameter| &parameter.name[..]);
    let of_convention = CONVENTION_VALUES.into_iter();
    let all: Vec<&str> = parameters
        .chain(FRAME_VALUES.map(|(name, _)| name))
        .chain(of_convention.filter(|name| names.convention.value(name).is_some()))
        .collect();
    all.join(", ")
}
