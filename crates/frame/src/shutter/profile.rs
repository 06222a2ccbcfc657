//! Opening and closing of a shutter, and exposure of the picture's rows.

use std::fmt;
use std::str::FromStr;

use super::error::ShutterError;
use super::interval::Shutter;
use crate::FileError;
use crate::exr::ExrFile;

/// Opening and closing within the interval of a [`Shutter`], and delay between rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShutterProfile {
    /// Fraction of the light that passes, over the interval.
    pub efficiency: Efficiency,
    /// Delay from the picture's upper to its lower border, in frames. Row `j` of `height` is
    /// shifted by `((j + 0.5) / height - 0.5)` of it, so that the middle is not shifted.
    pub rolling: f64,
}

/// Fraction of the light that passes, from opening to closing. Only its shape counts: times are
/// drawn in proportion to it.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Efficiency {
    /// All of the light throughout.
    #[default]
    Box,
    /// Rises linearly from 0, stays at 1, falls linearly to 0.
    Trapezoid {
        /// Part of the interval that opening takes; 0 and above.
        rise: f64,
        /// Part of the interval that closing takes; at most `1 - rise`.
        fall: f64,
    },
    /// Values in [0, 1] at equal steps from the opening to the closing, linear between them; at
    /// least two.
    Table(Vec<f64>),
}

impl ShutterProfile {
    /// Refuses impossible values.
    pub fn check(&self) -> Result<(), ShutterError> {
        self.efficiency.check()?;
        if self.rolling.is_finite() {
            Ok(())
        } else {
            Err(ShutterError::Rolling(self.rolling))
        }
    }

    /// Returns the delay of a row, out of `height`, relative to the middle of the picture, in
    /// frames.
    pub fn row_offset(&self, row: u32, height: u32) -> f64 {
        self.rolling * ((f64::from(row) + 0.5) / f64::from(height) - 0.5)
    }

    /// Returns the interval in which any row is exposed.
    pub fn whole(&self, shutter: Shutter) -> Shutter {
        let half = 0.5 * self.rolling.abs();
        Shutter {
            open: shutter.open - half,
            close: shutter.close + half,
        }
    }

    pub(crate) fn set(&self, file: &mut ExrFile) {
        file.set("shutter_efficiency", &self.efficiency);
        file.set("shutter_rolling", self.rolling);
    }

    pub(crate) fn from_exr(file: &ExrFile) -> Result<Self, FileError> {
        let profile = Self {
            efficiency: file.get("shutter_efficiency")?,
            rolling: file.get("shutter_rolling")?,
        };
        profile
            .check()
            .map_err(|error| file.foreign(error.to_string()))?;
        Ok(profile)
    }
}

impl Efficiency {
    /// Refuses impossible values.
    pub fn check(&self) -> Result<(), ShutterError> {
        match self {
            Efficiency::Box => Ok(()),
            Efficiency::Trapezoid { rise, fall } => {
                if *rise >= 0.0 && *fall >= 0.0 && rise + fall <= 1.0 {
                    Ok(())
                } else {
                    let (rise, fall) = (*rise, *fall);
                    Err(ShutterError::Ramps { rise, fall })
                }
            }
            Efficiency::Table(values) => {
                if values.len() < 2 {
                    return Err(ShutterError::Table(values.len()));
                }
                match values.iter().find(|value| !(0.0..=1.0).contains(*value)) {
                    Some(value) => Err(ShutterError::Efficiency(*value)),
                    None if values.iter().all(|value| *value == 0.0) => Err(ShutterError::Dark),
                    None => Ok(()),
                }
            }
        }
    }

    /// Lists points `[part of the interval, efficiency]` in rising order, linear in between; a jump
    /// is two points at one place.
    pub fn knots(&self) -> Vec<[f64; 2]> {
        match self {
            Efficiency::Box => vec![[0.0, 1.0], [1.0, 1.0]],
            Efficiency::Trapezoid { rise, fall } => {
                // Rounding of the difference must not reverse the order.
                let closing = (1.0 - fall).max(*rise);
                vec![[0.0, 0.0], [*rise, 1.0], [closing, 1.0], [1.0, 0.0]]
            }
            Efficiency::Table(values) => {
                let last = (values.len() - 1) as f64;
                (values.iter().enumerate())
                    .map(|(index, value)| [index as f64 / last, *value])
                    .collect()
            }
        }
    }
}

/// Writes the form used in files: `box`, `trapezoid 0.25 0.5`, `table 0 1 0.5`; numbers read back
/// equal.
impl fmt::Display for Efficiency {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Efficiency::Box => f.write_str("box"),
            Efficiency::Trapezoid { rise, fall } => write!(f, "trapezoid {rise} {fall}"),
            Efficiency::Table(values) => {
                f.write_str("table")?;
                values.iter().try_for_each(|value| write!(f, " {value}"))
            }
        }
    }
}

impl FromStr for Efficiency {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let unreadable =
            || format!("shutter efficiency \"{text}\" is unknown; allowed: box, trapezoid, table");
        let mut words = text.split_whitespace();
        let kind = words.next();
        let numbers: Vec<f64> = words
            .map(str::parse)
            .collect::<Result<_, _>>()
            .map_err(|_| unreadable())?;
        match (kind, numbers.as_slice()) {
            (Some("box"), []) => Ok(Efficiency::Box),
            (Some("trapezoid"), &[rise, fall]) => Ok(Efficiency::Trapezoid { rise, fall }),
            (Some("table"), _) => Ok(Efficiency::Table(numbers)),
            _ => Err(unreadable()),
        }
    }
}
