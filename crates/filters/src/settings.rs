//! The parameter values that a filter runs with.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use crate::text::without_controls;
use crate::{Filter, FilterError, Parameter, Unit, Value};

/// A value for every parameter of one filter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Settings {
    /// The preset that the values started from.
    pub preset: String,
    /// By parameter name.
    pub values: BTreeMap<String, Value>,
    /// Width of the pictures that the values in pixels are meant for; `None` where they are meant for every width.
    pub reference_width: Option<u32>,
    /// Parameters that stay as they are at every width: set by hand, or scaled already.
    pub fixed: BTreeSet<String>,
}

impl Settings {
    /// Sets a parameter from text, as the command line gives it.
    pub fn set(&mut self, filter: &Filter, parameter: &str, text: &str) -> Result<(), FilterError> {
        let known = find(filter, parameter)?;
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
        let known = find(filter, parameter)?;
        if !known.kind.allows(&value) {
            return Err(refuse(filter, known, &value.to_string()));
        }
        self.fix(parameter, value);
        Ok(())
    }

    /// Leaves every value as the preset has it, whatever the width.
    pub fn as_written(mut self) -> Self {
        self.reference_width = None;
        self
    }

    /// Fits the values in pixels to pictures `width` pixels wide: width / reference width times as much, unless they were set
    /// by hand. Whole numbers are rounded, and all of them stay in range.
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
            scaled.fix(&parameter.name, parameter.kind.scaled(value, factor));
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
            find(filter, name)?;
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

    /// The WGSL struct `Parameters`: four bytes per parameter, in order.
    pub(crate) fn bytes(&self, filter: &Filter) -> Vec<u8> {
        filter
            .parameters
            .iter()
            .flat_map(|parameter| parameter.kind.bytes(&self.values[&parameter.name]))
            .collect()
    }

    /// The value of an integer parameter that the folder's check found to be positive.
    pub(crate) fn count(&self, parameter: &str) -> u32 {
        match self.values[parameter] {
            Value::Integer(value) if value > 0 => value as u32,
            _ => unreachable!("counts come from integer parameters that start at 1"),
        }
    }
}

fn find<'f>(filter: &'f Filter, name: &str) -> Result<&'f Parameter, FilterError> {
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
                parameter: without_controls(name),
                reason: format!("the filter has no such parameter; {has}"),
            }
        })
}

fn refuse(filter: &Filter, parameter: &Parameter, found: &str) -> FilterError {
    FilterError::Parameter {
        filter: filter.name.clone(),
        parameter: parameter.name.clone(),
        reason: format!(
            "found {}; allowed: {}",
            without_controls(found),
            parameter.kind.allowed()
        ),
    }
}
