//! Reach of a smear, and the parameter that sets it.

use crate::{Filter, FilterError, Settings, Value};

/// A length in pixels.
#[derive(Clone, Debug, PartialEq)]
pub enum Length {
    /// This many.
    Pixels(u32),
    /// As many as this integer parameter says.
    Parameter(String),
}

/// The parameter that bounds how long a trail a filter can make.
#[derive(Clone, Debug, PartialEq)]
pub struct ReachBy {
    /// An integer parameter.
    pub parameter: String,
    /// How the reach grows with it.
    pub growth: Growth,
    /// The reach where the parameter is 1.
    pub unit: Length,
}

/// How the reach grows with a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Growth {
    /// Reach = unit x value: the side of a tile.
    Linear,
    /// Reach = unit x 2^(value - 1): the steps of a flood.
    Doubling,
}

impl Settings {
    /// These settings with the smallest reach that covers trails of `pixels`; as they are where the filter knows no
    /// bound. Refused where the parameter's range ends before.
    pub fn reaching(&self, filter: &Filter, pixels: u32) -> Result<Settings, FilterError> {
        let mut settings = self.clone();
        if let Some(reach_by) = &filter.reach_by {
            let units = pixels.div_ceil(self.pixels(&reach_by.unit)).max(1);
            let value = match reach_by.growth {
                Growth::Linear => units,
                Growth::Doubling => units.next_power_of_two().ilog2() + 1,
            };
            settings.set_value(filter, &reach_by.parameter, Value::Integer(value as i32))?;
        }
        Ok(settings)
    }

    pub(crate) fn pixels(&self, length: &Length) -> u32 {
        match length {
            Length::Pixels(pixels) => *pixels,
            Length::Parameter(parameter) => self.count(parameter),
        }
    }
}
