//! A filter with one set of its parameters.

use std::collections::BTreeMap;

use filters::{Filter, FilterError, Settings, Value};

/// A filter with one set of its parameters.
#[derive(Clone)]
pub struct FilterChoice {
    /// The filter.
    pub filter: Filter,
    /// Preset that the parameters started from.
    pub preset: String,
    /// The parameters.
    pub settings: Settings,
    /// Parameters with values that replace the preset's.
    pub overrides: BTreeMap<String, Value>,
    /// True if values in pixels stay as in the preset, whatever the picture's width.
    pub as_written: bool,
}

impl FilterChoice {
    /// Takes the filter's parameters from a preset.
    pub fn new(filter: Filter, preset: &str) -> Result<Self, FilterError> {
        Ok(Self {
            settings: filter.settings(Some(preset))?,
            filter,
            preset: preset.to_owned(),
            overrides: BTreeMap::new(),
            as_written: false,
        })
    }

    /// Sets a parameter to a new value, which then appears in the name.
    pub fn set(&mut self, parameter: &str, text: &str) -> Result<(), FilterError> {
        self.settings.set(&self.filter, parameter, text)?;
        let value = self.settings.values[parameter].clone();
        self.overrides.insert(parameter.to_owned(), value);
        Ok(())
    }

    /// Names filter, preset and overrides: `jump_flood:paper samples=8`.
    pub fn name(&self) -> String {
        format!("{}:{}", self.filter.name, self.preset) + &overrides_text(&self.overrides)
    }

    /// Keeps values in pixels as in the presets, if `asked`.
    pub fn as_written(mut self, asked: bool) -> Self {
        if asked {
            self.settings = self.settings.as_written();
        }
        self.as_written |= asked;
        self
    }

    /// Scales values in pixels to pictures `width` pixels wide, without the guard band.
    pub fn scaled_to(&self, width: u32) -> Self {
        Self {
            settings: self.settings.scaled_to(&self.filter, width),
            ..self.clone()
        }
    }

    /// Returns the parameters of any preset of the filter, for pictures `width` pixels wide.
    pub fn preset_at(&self, preset: &str, width: u32) -> Result<Settings, FilterError> {
        let settings = self.filter.settings(Some(preset))?;
        Ok(if self.as_written {
            settings.as_written()
        } else {
            settings.scaled_to(&self.filter, width)
        })
    }
}

/// Formats changed parameters for a name: ` samples=8 spread=0.5`.
pub(crate) fn overrides_text(overrides: &BTreeMap<String, Value>) -> String {
    let texts = overrides
        .iter()
        .map(|(parameter, value)| format!(" {parameter}={value}"));
    texts.collect()
}
