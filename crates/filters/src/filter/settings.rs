//! The parameter values that a filter runs with.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use super::convention::CONVENTION_VALUES;
use super::definition::Filter;
use super::parameter::{Kind, Parameter, Unit, Value};
use super::pass::Count;
use super::reach::Growth;
use crate::FilterError;

/// A value for every parameter of one filter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Settings {
    /// The preset that the values started from.
    pub preset: String,
    /// Values by parameter name.
    pub values: BTreeMap<String, Value>,
    /// Width of the pictures that the values in pixels are meant for; `None` if they are meant for
    /// every width.
    pub reference_width: Option<u32>,
    /// Parameters that stay as they are at every width: set by hand, or scaled already.
    pub fixed: BTreeSet<String>,
}

impl Filter {
    /// Returns the values of a preset, or of the first one.
    pub fn settings(&self, preset: Option<&str>) -> Result<Settings, FilterError> {
        let wanted = preset.unwrap_or(&self.presets[0].name);
        let names = self.presets.iter().map(|preset| &preset.name[..]);
        let preset = self.presets.iter().find(|preset| preset.name == wanted);
        let preset = preset.ok_or_else(|| {
            FilterError::Refused(format!(
                "filter {} has no preset \"{wanted}\"; allowed: {}",
                self.name,
                names.collect::<Vec<_>>().join(", ")
            ))
        })?;
        let mut values: BTreeMap<String, Value> = self
            .parameters
            .iter()
            .map(|parameter| (parameter.name.clone(), parameter.default.clone()))
            .collect();
        values.extend(preset.values.clone());
        Ok(Settings {
            preset: preset.name.clone(),
            values,
            reference_width: preset.reference_width,
            fixed: BTreeSet::new(),
        })
    }
}

impl Settings {
    /// Sets a parameter from text.
    pub fn set(&mut self, filter: &Filter, parameter: &str, text: &str) -> Result<(), FilterError> {
        let known = find_parameter(filter, parameter)?;
        let value = known
            .kind
            .parse(text)
            .ok_or_else(|| refuse(filter, known, text))?;
        self.fix(parameter, value);
        Ok(())
    }

    /// Sets a parameter to a value.
    pub fn set_value(
        &mut self,
        filter: &Filter,
        parameter: &str,
        value: Value,
    ) -> Result<(), FilterError> {
        let known = find_parameter(filter, parameter)?;
        if !known.kind.allows(&value) {
            return Err(refuse(filter, known, &value.to_string()));
        }
        self.fix(parameter, value);
        Ok(())
    }

    /// Keeps the preset's values unchanged at every width.
    pub fn as_written(mut self) -> Self {
        self.reference_width = None;
        self
    }

    /// Multiplies the values in pixels by `width` / reference width, for pictures `width` pixels
    /// wide. Values that were set by hand stay. Whole numbers are rounded, and all values stay in
    /// range.
    pub fn scaled_to(&self, filter: &Filter, width: u32) -> Self {
        let mut scaled = self.clone();
        let Some(reference_width) = self.reference_width else {
            return scaled;
        };
        let factor = f64::from(width) / f64::from(reference_width);
        let in_pixels =
            (filter.parameters.iter()).filter(|parameter| parameter.unit == Some(Unit::Pixels));
        for parameter in in_pixels.filter(|parameter| !self.fixed.contains(&parameter.name)) {
            let value = &self.values[&parameter.name];
            scaled.fix(&parameter.name, parameter.kind.scale(value, factor));
        }
        scaled
    }

    fn fix(&mut self, parameter: &str, value: Value) {
        self.values.insert(parameter.to_owned(), value);
        self.fixed.insert(parameter.to_owned());
    }

    /// Refuses settings that were made for another filter, or changed past what it allows.
    pub(crate) fn check(&self, filter: &Filter) -> Result<(), FilterError> {
        for name in self.values.keys() {
            find_parameter(filter, name)?;
        }
        for parameter in &filter.parameters {
            let value = self
                .values
                .get(&parameter.name)
                .ok_or_else(|| refuse(filter, parameter, "nothing"))?;
            if !parameter.kind.allows(value) {
                return Err(refuse(filter, parameter, &value.to_string()));
            }
        }
        Ok(())
    }

    /// Lists the numbers that expressions know by name, except a frame's: parameters and the
    /// convention.
    pub(crate) fn list_numbers(&self, filter: &Filter) -> BTreeMap<String, f64> {
        let convention = CONVENTION_VALUES.into_iter().filter_map(|name| {
            let value = filter.convention.value(name)?;
            Some((name.to_owned(), value))
        });
        // A parameter may have the name of a value of the convention.
        convention.chain(self.list_parameters(filter)).collect()
    }

    /// Lists the parameters with their values; a choice's value is its index.
    pub(crate) fn list_parameters(&self, filter: &Filter) -> impl Iterator<Item = (String, f64)> {
        filter.parameters.iter().map(|parameter| {
            let number = match (&self.values[&parameter.name], &parameter.kind) {
                (Value::Integer(value), _) => f64::from(*value),
                (Value::Real(value), _) => *value,
                (Value::Choice(name), Kind::Choice { choices }) => {
                    let index = choices.iter().position(|choice| choice == name);
                    index.expect("settings hold only allowed values") as f64
                }
                (Value::Choice(_), _) => unreachable!("settings hold only values of their kind"),
            };
            (parameter.name.clone(), number)
        })
    }

    /// Returns a number, or the value of an integer parameter, which the check of the folder found
    /// to be positive.
    pub(crate) fn count(&self, count: &Count) -> u32 {
        match count {
            Count::Number(number) => *number,
            Count::Parameter(name) => match self.values[name] {
                Value::Integer(value) if value > 0 => value as u32,
                _ => unreachable!("counts come from integer parameters that start at 1"),
            },
        }
    }

    /// Sets the smallest reach that covers trails of `pixels`. Changes nothing if the reach of the
    /// filter has no bound. Fails if the range of the parameter ends below that.
    pub fn with_reach(&self, filter: &Filter, pixels: u32) -> Result<Settings, FilterError> {
        let mut settings = self.clone();
        if let Some(reach_by) = &filter.reach_by {
            let units = pixels.div_ceil(self.count(&reach_by.unit)).max(1);
            let value = match reach_by.growth {
                Growth::Linear => units,
                Growth::Doubling => units.next_power_of_two().ilog2() + 1,
            };
            settings.set_value(filter, &reach_by.parameter, Value::Integer(value as i32))?;
        }
        Ok(settings)
    }
}

fn find_parameter<'f>(filter: &'f Filter, name: &str) -> Result<&'f Parameter, FilterError> {
    let mut parameters = filter.parameters.iter();
    parameters
        .find(|parameter| parameter.name == name)
        .ok_or_else(|| {
            let names: Vec<&str> = filter.parameters.iter().map(|p| p.name.as_str()).collect();
            let has = if names.is_empty() {
                "it has none".to_owned()
            } else {
                format!("allowed: {}", names.join(", "))
            };
            FilterError::Parameter {
                filter: filter.name.clone(),
                parameter: name.to_owned(),
                reason: format!("the filter has no such parameter; {has}"),
            }
        })
}

fn refuse(filter: &Filter, parameter: &Parameter, value: &str) -> FilterError {
    FilterError::Parameter {
        filter: filter.name.clone(),
        parameter: parameter.name.clone(),
        reason: format!("found {value}; allowed: {}", parameter.kind.allowed()),
    }
}
