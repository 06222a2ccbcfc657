//! `[[parameter]]` of filter.toml.

use serde::Deserialize;
use toml::Spanned;

use super::file::File;
use super::number::{IDENTIFIER, is_identifier};
use crate::one_line::check_line;
use crate::{FilterError, Kind, Parameter, Scale, Unit, Value};

/// Upper limit on the choices of a parameter.
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
    no_camera_at: Option<toml::Value>,
    doc: String,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum KindWord {
    Integer,
    Real,
    Choice,
}

fn yes() -> bool {
    true
}

/// Reads every parameter.
pub(super) fn read_parameters(
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
        let kind = read_kind(entry).map_err(|reason| file.at(spanned, named(reason)))?;
        let default = read_value(&kind, &entry.default).ok_or_else(|| {
            let allowed = kind.allowed();
            file.at(
                spanned,
                named(format!("default {} is not {allowed}", entry.default)),
            )
        })?;
        let off = entry.no_camera_at.as_ref().map(|off| {
            read_value(&kind, off).ok_or_else(|| {
                let allowed = kind.allowed();
                file.at(
                    spanned,
                    named(format!("no_camera_at {off} is not {allowed}")),
                )
            })
        });
        if entry.unit.is_some() && matches!(kind, Kind::Choice { .. }) {
            let reason = "a choice is counted in nothing; leave unit out";
            return Err(file.at(spanned, named(reason.into())));
        }
        let doc = file.check_line(spanned, &named("doc".into()), &entry.doc)?;
        parameters.push(Parameter {
            name: entry.name.clone(),
            kind,
            default,
            unit: entry.unit,
            tunable: entry.tunable,
            no_camera_at: off.transpose()?,
            doc,
        });
    }
    Ok(parameters)
}

fn read_kind(entry: &ParameterEntry) -> Result<Kind, String> {
    let scale = entry.scale.unwrap_or_default();
    let [min, max] = match (entry.kind, entry.range, &entry.choices) {
        (KindWord::Choice, None, Some(choices)) if choices.len() > MAX_CHOICES => {
            return Err(format!(
                "{} choices; allowed: at most {MAX_CHOICES}",
                choices.len()
            ));
        }
        (KindWord::Choice, None, Some(choices)) if entry.scale.is_none() => {
            if let Some(reason) = choices.iter().find_map(|choice| check_line(choice).err()) {
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

/// Reads a TOML value as one of `kind`; whole numbers are real ones too.
pub(super) fn read_value(kind: &Kind, given: &toml::Value) -> Option<Value> {
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
