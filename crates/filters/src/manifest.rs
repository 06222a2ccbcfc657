//! `filter.toml`: from text to a [`Filter`] without kernels.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use frame::Alignment;
use serde::{Deserialize, Deserializer, de::Error};
use toml::Spanned;

use crate::filter::{Filter, Format, Pass, Preset, Repeat, Texture};
use crate::gpu::Shader;
use crate::{FilterError, Kind, Parameter, Scale, Value};

/// Where things are declared in `filter.toml`, for messages: lines from 1.
pub(crate) struct Lines {
    pub path: PathBuf,
    pub parameters: Vec<usize>,
    pub textures: Vec<usize>,
    pub passes: Vec<usize>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Manifest {
    name: Spanned<String>,
    summary: String,
    #[serde(default)]
    source: String,
    #[serde(default)]
    reach: String,
    #[serde(default)]
    cannot: String,
    #[serde(deserialize_with = "alignment")]
    alignment: Alignment,
    #[serde(default)]
    mirror_symmetric: bool,
    #[serde(default)]
    parameter: Vec<Spanned<ParameterEntry>>,
    #[serde(default)]
    preset: Vec<Spanned<PresetEntry>>,
    #[serde(default)]
    texture: Vec<Spanned<TextureEntry>>,
    pass: Vec<Spanned<PassEntry>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ParameterEntry {
    name: String,
    kind: KindWord,
    default: toml::Value,
    range: Option<[f64; 2]>,
    choices: Option<Vec<String>>,
    scale: Option<Scale>,
    #[serde(default = "yes")]
    tunable: bool,
    doc: String,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum KindWord {
    Integer,
    Real,
    Choice,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PresetEntry {
    name: String,
    doc: String,
    #[serde(default)]
    values: BTreeMap<String, Spanned<toml::Value>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TextureEntry {
    name: String,
    format: Format,
    divided_by: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PassEntry {
    entry: String,
    over: Option<String>,
    repeat: Option<RepeatEntry>,
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "repeat is a count from 1 or the name of an integer parameter"
)]
enum RepeatEntry {
    Times(u32),
    Parameter(String),
}

fn yes() -> bool {
    true
}

fn alignment<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Alignment, D::Error> {
    Alignment::from_str(&String::deserialize(deserializer)?).map_err(D::Error::custom)
}

/// Reads `filter.toml`. The filter comes back without kernels, and the lines of its declarations beside it.
pub(crate) fn read(path: &Path, text: &str) -> Result<(Filter, Lines), FilterError> {
    let file = File { path, text };
    let manifest: Manifest = toml::from_str(text).map_err(|error| {
        let start = error.span().map(|span| span.start);
        file.refuse(start, error.message().to_owned())
    })?;
    let name = manifest.name.get_ref();
    if !is_identifier(name) {
        return Err(file.at(
            &manifest.name,
            format!("name \"{name}\": {IDENTIFIER}; it also names the WGSL file"),
        ));
    }
    let parameters = parameters(&file, &manifest.parameter)?;
    let filter = Filter {
        name: name.clone(),
        presets: presets(&file, &manifest.preset, &parameters)?,
        textures: textures(&file, &manifest.texture, &parameters)?,
        passes: passes(&file, &manifest, &parameters)?,
        parameters,
        summary: manifest.summary,
        source: manifest.source,
        reach: manifest.reach,
        cannot: manifest.cannot,
        alignment: manifest.alignment,
        mirror_symmetric: manifest.mirror_symmetric,
        shader: Shader::default(),
    };
    let lines = Lines {
        path: path.to_owned(),
        parameters: file.lines(&manifest.parameter),
        textures: file.lines(&manifest.texture),
        passes: file.lines(&manifest.pass),
    };
    Ok((filter, lines))
}

fn parameters(
    file: &File,
    entries: &[Spanned<ParameterEntry>],
) -> Result<Vec<Parameter>, FilterError> {
    let mut parameters = Vec::<Parameter>::new();
    for spanned in entries {
        let entry = spanned.get_ref();
        let named = |reason: String| format!("parameter \"{}\": {reason}", entry.name);
        if !is_identifier(&entry.name) {
            return Err(file.at(spanned, named(IDENTIFIER.into())));
        }
        if parameters.iter().any(|known| known.name == entry.name) {
            return Err(file.at(spanned, named("is declared twice".into())));
        }
        let kind = kind(entry).map_err(|reason| file.at(spanned, named(reason)))?;
        let default = value(&kind, &entry.default).ok_or_else(|| {
            let allowed = kind.allowed();
            file.at(
                spanned,
                named(format!("default {} is not {allowed}", entry.default)),
            )
        })?;
        parameters.push(Parameter {
            name: entry.name.clone(),
            kind,
            default,
            tunable: entry.tunable,
            doc: entry.doc.clone(),
        });
    }
    Ok(parameters)
}

fn kind(entry: &ParameterEntry) -> Result<Kind, String> {
    let scale = entry.scale.unwrap_or_default();
    let [min, max] = match (entry.kind, entry.range, &entry.choices) {
        (KindWord::Choice, None, Some(choices)) if entry.scale.is_none() => {
            let distinct = |(index, choice): (usize, &String)| !choices[..index].contains(choice);
            return if choices.len() >= 2 && choices.iter().enumerate().all(distinct) {
                Ok(Kind::Choice {
                    choices: choices.clone(),
                })
            } else {
                Err("a choice needs at least two different names in choices".into())
            };
        }
        (KindWord::Choice, ..) => {
            return Err("a choice has choices, and neither range nor scale".into());
        }
        (_, Some(range), None) => range,
        _ => return Err("a number has a range, and no choices".into()),
    };
    if !(min.is_finite() && max.is_finite() && min < max) {
        return Err(format!(
            "range [{min}, {max}] is empty; allowed: two finite numbers, the smaller first"
        ));
    }
    if scale == Scale::Log && min <= 0.0 {
        return Err(format!(
            "a logarithmic scale needs a range above 0; it starts at {min}"
        ));
    }
    let whole = |end: f64| (f64::from(end as i32) == end).then_some(end as i32);
    match (entry.kind, whole(min), whole(max)) {
        (KindWord::Integer, Some(min), Some(max)) => Ok(Kind::Integer { min, max, scale }),
        (KindWord::Integer, ..) => Err(format!(
            "range [{min}, {max}] of an integer has ends that are no 32-bit integers"
        )),
        _ => Ok(Kind::Real { min, max, scale }),
    }
}

fn presets(
    file: &File,
    entries: &[Spanned<PresetEntry>],
    parameters: &[Parameter],
) -> Result<Vec<Preset>, FilterError> {
    let mut presets = Vec::<Preset>::new();
    for spanned in entries {
        let entry = spanned.get_ref();
        if !is_identifier(&entry.name) || presets.iter().any(|known| known.name == entry.name) {
            let reason = format!(
                "preset \"{}\": {IDENTIFIER}, and no two presets share one",
                entry.name
            );
            return Err(file.at(spanned, reason));
        }
        let mut values = BTreeMap::new();
        for (name, given) in &entry.values {
            let named = |reason: String| {
                file.at(given, format!("preset \"{}\": {name} {reason}", entry.name))
            };
            let parameter = parameters
                .iter()
                .find(|parameter| parameter.name == *name)
                .ok_or_else(|| named("is no parameter of this filter".into()))?;
            let value = value(&parameter.kind, given.get_ref()).ok_or_else(|| {
                let allowed = parameter.kind.allowed();
                named(format!("= {} is not {allowed}", given.get_ref()))
            })?;
            values.insert(name.clone(), value);
        }
        presets.push(Preset {
            name: entry.name.clone(),
            doc: entry.doc.clone(),
            values,
        });
    }
    if presets.is_empty() {
        presets.push(Preset {
            name: "default".into(),
            doc: "Every parameter at its default.".into(),
            values: BTreeMap::new(),
        });
    }
    Ok(presets)
}

fn textures(
    file: &File,
    entries: &[Spanned<TextureEntry>],
    parameters: &[Parameter],
) -> Result<Vec<Texture>, FilterError> {
    let mut textures = Vec::<Texture>::new();
    for spanned in entries {
        let TextureEntry {
            name,
            format,
            divided_by,
        } = spanned.get_ref();
        if !is_identifier(name) || BUILTIN_VARIABLES.contains(&name.as_str()) {
            let reason = format!(
                "texture \"{name}\": {IDENTIFIER}, and none of {}",
                BUILTIN_VARIABLES.join(", ")
            );
            return Err(file.at(spanned, reason));
        }
        if textures.iter().any(|known| known.name == *name) {
            return Err(file.at(spanned, format!("texture \"{name}\" is declared twice")));
        }
        if let Some(parameter) = divided_by {
            count(parameters, parameter).map_err(|reason| {
                file.at(
                    spanned,
                    format!("texture \"{name}\": divided_by = {reason}"),
                )
            })?;
        }
        textures.push(Texture {
            name: name.clone(),
            format: *format,
            divided_by: divided_by.clone(),
        });
    }
    Ok(textures)
}

fn passes(
    file: &File,
    manifest: &Manifest,
    parameters: &[Parameter],
) -> Result<Vec<Pass>, FilterError> {
    let mut passes = Vec::new();
    for spanned in &manifest.pass {
        let PassEntry {
            entry,
            over,
            repeat,
        } = spanned.get_ref();
        let named = |reason: String| file.at(spanned, format!("pass \"{entry}\": {reason}"));
        let mut textures = manifest.texture.iter().map(Spanned::get_ref);
        if let Some(over) = over
            && !textures.any(|texture| texture.name == *over)
        {
            return Err(named(format!(
                "over = \"{over}\" names no declared texture; leave it out to run over the image"
            )));
        }
        let repeat = match repeat {
            None => Repeat::Times(1),
            Some(RepeatEntry::Times(0)) => {
                return Err(named("repeat = 0; allowed: 1 or more".into()));
            }
            Some(RepeatEntry::Times(times)) => Repeat::Times(*times),
            Some(RepeatEntry::Parameter(parameter)) => {
                count(parameters, parameter)
                    .map_err(|reason| named(format!("repeat = {reason}")))?;
                Repeat::Parameter(parameter.clone())
            }
        };
        passes.push(Pass {
            entry: entry.clone(),
            over: over.clone(),
            repeat,
        });
    }
    Ok(passes)
}

/// Names that kernels use for what the runner gives them, and for what it takes.
const BUILTIN_VARIABLES: [&str; 6] = [
    "color",
    "velocity",
    "depth",
    "output",
    "parameters",
    "frame",
];

const IDENTIFIER: &str = "a name is made of a-z, 0-9 and _, and begins with a letter";

fn is_identifier(name: &str) -> bool {
    name.starts_with(|first: char| first.is_ascii_lowercase())
        && name
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
}

/// Whether a parameter can say how often or how large.
fn count(parameters: &[Parameter], name: &str) -> Result<(), String> {
    let parameter = parameters.iter().find(|parameter| parameter.name == name);
    match parameter.map(|parameter| &parameter.kind) {
        None => Err(format!("\"{name}\" is no parameter of this filter")),
        Some(Kind::Integer { min, .. }) if *min >= 1 => Ok(()),
        Some(_) => Err(format!(
            "\"{name}\" is not an integer parameter whose range begins at 1 or more"
        )),
    }
}

/// A TOML value as one of `kind`; whole numbers stand for real ones too.
fn value(kind: &Kind, given: &toml::Value) -> Option<Value> {
    let value = match (kind, given) {
        (Kind::Integer { .. }, toml::Value::Integer(value)) => {
            Value::Integer(i32::try_from(*value).ok()?)
        }
        (Kind::Real { .. }, toml::Value::Float(value)) => Value::Real(*value),
        (Kind::Real { .. }, toml::Value::Integer(value)) => Value::Real(*value as f64),
        (Kind::Choice { .. }, toml::Value::String(name)) => Value::Choice(name.clone()),
        _ => return None,
    };
    kind.allows(&value).then_some(value)
}

struct File<'a> {
    path: &'a Path,
    text: &'a str,
}

impl File<'_> {
    fn refuse(&self, offset: Option<usize>, reason: String) -> FilterError {
        FilterError::Folder {
            path: self.path.to_owned(),
            line: offset.map(|offset| self.line(offset)),
            reason,
        }
    }

    fn at<T>(&self, place: &Spanned<T>, reason: String) -> FilterError {
        self.refuse(Some(place.span().start), reason)
    }

    fn line(&self, offset: usize) -> usize {
        self.text[..offset].matches('\n').count() + 1
    }

    fn lines<T>(&self, entries: &[Spanned<T>]) -> Vec<usize> {
        entries
            .iter()
            .map(|entry| self.line(entry.span().start))
            .collect()
    }
}
