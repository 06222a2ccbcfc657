//! Parameters of a filter, which a person or a tuner may change.

use serde::{Deserialize, Serialize};

/// One parameter of a filter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Parameter {
    /// Name in `filter.toml`, in the WGSL struct `Parameters` and on the command line.
    pub name: String,
    /// The values that it allows.
    #[serde(flatten)]
    pub kind: Kind,
    /// The value unless a preset names another.
    pub default: Value,
    /// Its unit, if that depends on the size of the picture.
    pub unit: Option<Unit>,
    /// True if a tuner may change it.
    pub tunable: bool,
    /// The value at which the kernels do not read the camera's motion, so that frames without it can be blurred.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub no_camera_at: Option<Value>,
    /// Meaning and unit, and what raising it costs.
    pub doc: String,
}

/// Allowed values of a parameter, both ends of a range included.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Kind {
    /// Whole numbers; `i32` in WGSL.
    Integer {
        /// Smallest value.
        min: i32,
        /// Largest value.
        max: i32,
        /// Steps of a tuner through the range.
        scale: Scale,
    },
    /// Real numbers; `f32` in WGSL.
    Real {
        /// Smallest value.
        min: f64,
        /// Largest value.
        max: f64,
        /// Steps of a tuner through the range.
        scale: Scale,
    },
    /// One of a few names; their index as `u32` in WGSL.
    Choice {
        /// The names, in the order of their indices.
        choices: Vec<String>,
    },
}

/// Division of a range into steps of equal importance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// Equal differences.
    #[default]
    Linear,
    /// Equal ratios.
    Log,
}

/// Unit of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Unit {
    /// Pixels of the picture. Twice the width of the picture doubles the value.
    Pixels,
}

/// A parameter's value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// Value of an integer parameter.
    Integer(i32),
    /// Value of a real parameter.
    Real(f64),
    /// Name of a choice.
    Choice(String),
}

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Value::Integer(value) => write!(f, "{value}"),
            Value::Real(value) => write!(f, "{value}"),
            Value::Choice(name) => f.write_str(name),
        }
    }
}

impl Kind {
    /// Describes the values that are allowed.
    pub fn allowed(&self) -> String {
        match self {
            Kind::Integer { min, max, .. } => format!("a whole number from {min} to {max}"),
            Kind::Real { min, max, .. } => format!("a number from {min} to {max}"),
            Kind::Choice { choices } => format!("one of {}", choices.join(", ")),
        }
    }

    /// Returns true if the value is of this kind and in range.
    pub fn allows(&self, value: &Value) -> bool {
        match (self, value) {
            (Kind::Integer { min, max, .. }, Value::Integer(value)) => (min..=max).contains(&value),
            (Kind::Real { min, max, .. }, Value::Real(value)) => (min..=max).contains(&value),
            (Kind::Choice { choices }, Value::Choice(name)) => choices.contains(name),
            _ => false,
        }
    }

    /// Parses a value; `None` if this kind does not allow it.
    pub fn parse(&self, text: &str) -> Option<Value> {
        let value = match self {
            Kind::Integer { .. } => Value::Integer(text.parse().ok()?),
            Kind::Real { .. } => Value::Real(text.parse().ok()?),
            Kind::Choice { .. } => Value::Choice(text.to_owned()),
        };
        self.allows(&value).then_some(value)
    }

    /// Multiplies a number by a factor, rounds it if it is whole, and clamps it to the range. Choices stay as they are.
    pub(crate) fn scale(&self, value: &Value, factor: f64) -> Value {
        match (self, value) {
            (Kind::Integer { min, max, .. }, Value::Integer(value)) => {
                let scaled = (f64::from(*value) * factor).round();
                Value::Integer(scaled.clamp(f64::from(*min), f64::from(*max)) as i32)
            }
            (Kind::Real { min, max, .. }, Value::Real(value)) => {
                Value::Real((value * factor).clamp(*min, *max))
            }
            (_, value) => value.clone(),
        }
    }

    /// Names the scalar type of the member in the WGSL struct.
    pub(crate) fn wgsl_type(&self) -> &'static str {
        match self {
            Kind::Integer { .. } => "i32",
            Kind::Real { .. } => "f32",
            Kind::Choice { .. } => "u32",
        }
    }
}
