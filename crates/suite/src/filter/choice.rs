//! A filter with one set of its parameters.

use filters::{Filter, FilterError, Settings};

/// A filter with one set of its parameters.
#[derive(Clone)]
pub struct FilterChoice {
    /// The filter.
    pub filter: Filter,
    /// The preset that the parameters started from.
    pub preset: String,
    /// The parameters.
    pub settings: Settings,
    /// True if values in pixels stay as the preset has them, whatever the picture's width.
    pub as_written: bool,
}

impl FilterChoice {
    /// Takes the parameters of a preset, as the filter has them.
    pub fn new(filter: Filter, preset: &str) -> Result<Self, FilterError> {
        Ok(Self {
            settings: filter.settings(Some(preset))?,
            filter,
            preset: preset.to_owned(),
            as_written: false,
        })
    }

    /// Names filter and preset: `jump_flood:paper`.
    pub fn name(&self) -> String {
        format!("{}:{}", self.filter.name, self.preset)
    }

    /// Keeps values in pixels as the presets have them, if that is asked for.
    pub fn as_written(mut self, asked: bool) -> Self {
        if asked {
            self.settings = self.settings.as_written();
        }
        self.as_written |= asked;
        self
    }

    /// Scales values in pixels to pictures `width` pixels wide, guard band left out.
    pub fn scaled_to(&self, width: u32) -> Self {
        Self {
            settings: self.settings.scaled_to(&self.filter, width),
            ..self.clone()
        }
    }

    /// Returns the parameters of any preset of the filter, for pictures `width` pixels wide.
    pub fn preset_at(&self, preset: &str, width: u32) -> Result<Settings, FilterError> {
        let settings = self.filter.settings(Some(preset))?;
        Ok(match self.as_written {
            true => settings.as_written(),
            false => settings.scaled_to(&self.filter, width),
        })
    }
}
