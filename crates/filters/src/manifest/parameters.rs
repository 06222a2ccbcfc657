//! `[[parameter]]` and `[[preset]]`.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use super::source::{SourceEntry, source};
use super::{File, IDENTIFIER, is_identifier};
use crate::filter::Preset;
use crate::text::unfit;
use crate::{FilterError, Kind, Parameter, Scale, Tuned, Unit, Value};

/// How many choices a parameter may have.
pub const MAX_CHOICES: usize = 64;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ParameterEntry {
    name: String,
    kind: KindWord,
    default: toml::Value,
    range: Option<[f64; 2]>,
    choices: Option<Vec<String>>,
    scale: Option<Scale>,
    unit: Option<Unit>,
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
pub(super) struct PresetEntry {
    name: String,
    doc: String,
    #[serde(default)]
    values: BTreeMap<String, Spanned<toml::Value>>,
    source: Option<Spanned<SourceEntry>>,
    reference_width: Option<Spanned<u32>>,
    tuned: Option<Tuned>,
}

fn yes() -> bool {
    true
}

pub(super) fn parameters(
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
        if entry.unit.is_some() && matches!(kind, Kind::Choice { .. }) {
            let reason = "a choice is counted in nothing; leave unit out";
            return Err(file.at(spanned, named(reason.into())));
        }
        let doc = file.one_line(spanned, &named("doc".into()), &entry.doc)?;
        parameters.push(Parameter {
            name: entry.name.clone(),
            kind,
            default,
            unit: entry.unit,
            tunable: entry.tunable,
            doc,
        });
    }
    Ok(parameters)
}

fn kind(entry: &ParameterEntry) -> Result<Kind, String> {
    let scale = entry.scale.unwrap_or_default();
    let [min, max] = match (entry.kind, entry.range, &entry.choices) {
        (KindWord::Choice, None, Some(choices)) if choices.len() > MAX_CHOICES => {
            return Err(format!(
                "{} choices; allowed: at most {MAX_CHOICES}",
                choices.len()
            ));
        }
        (KindWord::Choice, None, Some(choices)) if entry.scale.is_none() => {
            if let Some(reason) = choices.iter().find_map(|choice| unfit(choice)) {
                return Err(format!("one of its choices {reason}"));
            }
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
    // Kernels get the value as an f32.
    let vanishes = |end: f64| end != 0.0 && (end as f32) == 0.0;
    if [min, max]
        .iter()
        .any(|end| !(*end as f32).is_finite() || vanishes(*end))
    {
        return Err(format!(
            "range [{min:e}, {max:e}] has an end that no f32 holds; allowed: 0, or from 1e-45 to 3.4e38 on either side of it"
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

pub(super) fn presets(
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
        let doc = format!("preset \"{}\": doc", entry.name);
        let doc = file.one_line(spanned, &doc, &entry.doc)?;
        if let Some(tuned) = &entry.tuned {
            for text in [&tuned.by, &tuned.from].into_iter().chain(&tuned.scenes) {
                file.one_line(spanned, &format!("preset \"{}\": tuned", entry.name), text)?;
            }
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
        if let Some(tuned) = &entry.tuned
            && presets.iter().all(|known| known.name != tuned.from)
        {
            let reason = format!(
                "preset \"{}\": tuned from \"{}\", which is no preset before it",
                entry.name, tuned.from
            );
            return Err(file.at(spanned, reason));
        }
        presets.push(Preset {
            name: entry.name.clone(),
            doc,
            source: source(file, &entry.name, entry.source.as_ref())?,
            reference_width: reference_width(file, entry, parameters)?,
            values,
            tuned: entry.tuned.clone(),
        });
    }
    if presets.is_empty() {
        presets.push(Preset {
            name: "default".into(),
            doc: "Every parameter at its default.".into(),
            source: None,
            reference_width: None,
            values: BTreeMap::new(),
            tuned: None,
        });
    }
    Ok(presets)
}

/// The width that a preset was made for; refused where that changes no parameter.
fn reference_width(
    file: &File,
    entry: &PresetEntry,
    parameters: &[Parameter],
) -> Result<Option<u32>, FilterError> {
    let Some(spanned) = &entry.reference_width else {
        return Ok(None);
    };
    let width = *spanned.get_ref();
    let refuse = |reason: &str| {
        let name = &entry.name;
        let reason = format!("preset \"{name}\": reference_width = {width}{reason}");
        file.at(spanned, reason)
    };
    if width == 0 {
        return Err(refuse("; allowed: 1 pixel or more"));
    }
    if parameters.iter().all(|parameter| parameter.unit.is_none()) {
        return Err(refuse(
            ", but no parameter has unit = \"pixels\", so that there is nothing to scale; leave it out",
        ));
    }
    Ok(Some(width))
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
