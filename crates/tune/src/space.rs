//! Parameters that a tuning may change, and their mapping to the unit cube.

use filters::{Filter, Kind, Parameter, Scale, Settings, Value};
use judge::round_to_digits;
use measure::Error;

/// Some parameters of a filter with their ranges, around a set of values.
#[derive(Clone, Debug)]
pub struct Space {
    /// Start values; all other parameters keep them.
    pub start: Settings,
    /// Parameters that may change, each within its own range.
    pub axes: Vec<Parameter>,
}

impl Space {
    /// Makes an axis from each parameter that `vary` names, as `name` or `name=low..high`; from
    /// every tunable one if it names none.
    pub fn new(filter: &Filter, start: Settings, vary: &[String]) -> Result<Self, Error> {
        let tunable = filter
            .parameters
            .iter()
            .filter(|parameter| parameter.tunable);
        let tunable: Vec<&Parameter> = tunable.collect();
        let names: Vec<&str> = tunable
            .iter()
            .map(|parameter| parameter.name.as_str())
            .collect();
        if names.is_empty() {
            return Err(Error::Refused(format!(
                "filter {} has no tunable parameter: there is nothing to tune",
                filter.name
            )));
        }
        let axes = if vary.is_empty() {
            tunable.into_iter().cloned().collect()
        } else {
            read_axes(filter, &names, vary)?
        };
        match axes.iter().find(|axis| !can_vary(&axis.kind)) {
            Some(axis) => Err(Error::Refused(format!(
                "{}.{}: its range is {}, one value alone; leave it out",
                filter.name,
                axis.name,
                axis.kind.allowed()
            ))),
            None => Ok(Self { start, axes }),
        }
    }

    /// Returns the values at a point of the unit cube.
    pub fn settings(&self, point: &[f64]) -> Settings {
        assert_eq!(
            point.len(),
            self.axes.len(),
            "a point has one coordinate per axis"
        );
        let mut settings = self.start.clone();
        for (axis, coordinate) in self.axes.iter().zip(point) {
            let value = value_at(&axis.kind, *coordinate);
            settings.values.insert(axis.name.clone(), value);
        }
        settings
    }

    /// Maps values to the unit cube; clamps values outside an axis's range.
    pub fn point(&self, settings: &Settings) -> Vec<f64> {
        let axes = self.axes.iter();
        axes.map(|axis| coordinate_of(&axis.kind, &settings.values[&axis.name]))
            .collect()
    }

    /// Returns the distance between two sets of values: root mean square over the axes, each of
    /// length 1.
    pub fn distance(&self, a: &Settings, b: &Settings) -> f64 {
        let (a, b) = (self.point(a), self.point(b));
        let squares: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum();
        (squares / a.len() as f64).sqrt()
    }
}

/// Reads the words of `vary`: an axis each. `names` are the tunable parameters, for messages.
fn read_axes(filter: &Filter, names: &[&str], vary: &[String]) -> Result<Vec<Parameter>, Error> {
    let mut axes: Vec<Parameter> = Vec::new();
    for word in vary {
        let refuse = |reason: String| Error::Refused(format!("parameter {word}: {reason}"));
        let (name, range) = match word.split_once('=') {
            Some((name, range)) => (name, Some(range)),
            None => (word.as_str(), None),
        };
        let Some(parameter) = filter
            .parameters
            .iter()
            .find(|parameter| parameter.name == name)
        else {
            return Err(refuse(format!(
                "filter {} has no parameter \"{name}\"; allowed: {}",
                filter.name,
                names.join(", ")
            )));
        };
        if !parameter.tunable {
            return Err(refuse(format!(
                "its filter.toml says tunable = false; allowed: {}",
                names.join(", ")
            )));
        }
        if axes.iter().any(|axis| axis.name == name) {
            return Err(refuse("it is named twice".to_owned()));
        }
        let mut axis = parameter.clone();
        if let Some(range) = range {
            axis.kind = narrow(&parameter.kind, range).map_err(refuse)?;
        }
        axes.push(axis);
    }
    Ok(axes)
}

/// Narrows a range to `low..high`.
fn narrow(kind: &Kind, range: &str) -> Result<Kind, String> {
    let example = "allowed: a part of it, such as samples=4..16";
    let ends = range
        .split_once("..")
        .and_then(|(low, high)| Some((kind.parse(low.trim())?, kind.parse(high.trim())?)));
    let refuse = |reason: &str| {
        Err(format!(
            "{reason}; its range is {}, {example}",
            kind.allowed()
        ))
    };
    let mut narrowed = kind.clone();
    match (&mut narrowed, ends) {
        (Kind::Integer { min, max, .. }, Some((Value::Integer(low), Value::Integer(high)))) => {
            (*min, *max) = (low, high);
        }
        (Kind::Real { min, max, .. }, Some((Value::Real(low), Value::Real(high)))) => {
            (*min, *max) = (low, high);
        }
        (Kind::Choice { .. }, _) => return Err("a choice has no range; name it alone".to_owned()),
        _ => return refuse("no range within the parameter's own"),
    }
    if can_vary(&narrowed) {
        Ok(narrowed)
    } else {
        refuse("the range is empty")
    }
}

fn can_vary(kind: &Kind) -> bool {
    match kind {
        Kind::Integer { min, max, .. } => min < max,
        Kind::Real { min, max, .. } => min < max,
        Kind::Choice { choices } => choices.len() > 1,
    }
}

/// Returns the ends and the scale of a coordinate's range. A whole number has half a step on either
/// side, so that the first and the last occur as often as any other.
fn coordinate_range(kind: &Kind) -> (f64, f64, Scale) {
    match kind {
        Kind::Integer { min, max, scale } => (f64::from(*min) - 0.5, f64::from(*max) + 0.5, *scale),
        Kind::Real { min, max, scale } => (*min, *max, *scale),
        Kind::Choice { choices } => (-0.5, choices.len() as f64 - 0.5, Scale::Linear),
    }
}

fn value_at(kind: &Kind, coordinate: f64) -> Value {
    let (low, high, scale) = coordinate_range(kind);
    let coordinate = coordinate.clamp(0.0, 1.0);
    let number = match scale {
        Scale::Linear => low + coordinate * (high - low),
        Scale::Log => (low.ln() + coordinate * (high.ln() - low.ln())).exp(),
    };
    match kind {
        Kind::Integer { min, max, .. } => Value::Integer((number.round() as i32).clamp(*min, *max)),
        // As a person would write it into a file; equal digits make equal candidates.
        Kind::Real { min, max, .. } => Value::Real(round_to_digits(number, 4).clamp(*min, *max)),
        Kind::Choice { choices } => {
            let index = (number.round().max(0.0) as usize).min(choices.len() - 1);
            Value::Choice(choices[index].clone())
        }
    }
}

fn coordinate_of(kind: &Kind, value: &Value) -> f64 {
    let (low, high, scale) = coordinate_range(kind);
    let number = match (kind, value) {
        (Kind::Choice { choices }, Value::Choice(name)) => {
            let index = choices.iter().position(|choice| choice == name);
            index.expect("settings hold only allowed values") as f64
        }
        (_, Value::Integer(value)) => f64::from(*value),
        (_, Value::Real(value)) => *value,
        (_, Value::Choice(_)) => unreachable!("settings hold only values of their kind"),
    };
    let number = number.clamp(low, high);
    match scale {
        Scale::Linear => (number - low) / (high - low),
        Scale::Log => (number.ln() - low.ln()) / (high.ln() - low.ln()),
    }
}
