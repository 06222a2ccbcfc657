//! `[[pass.binding]]` of filter.toml, and the numbers that it names.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use super::file::{File, MAX_ENTRIES};
use crate::filter::{Binding, BindingPlace, count_numbers, explain_unknown, list_values};
use crate::shader::{SamplerFilter, Sampling, Wrap};
use crate::{Convention, Expression, FilterError, Parameter, Texture};

/// `[[pass.binding]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BindingEntry {
    #[serde(default, alias = "set")]
    group: u32,
    binding: Option<u32>,
    name: Option<String>,
    #[serde(default)]
    push_constants: bool,
    #[serde(default)]
    globals: bool,
    texture: Option<String>,
    level: Option<NumberEntry>,
    sampler: Option<SamplerFilter>,
    mip_filter: Option<SamplerFilter>,
    wrap: Option<Wrap>,
    #[serde(default)]
    values: BTreeMap<String, ValueEntry>,
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "a value is a number, a text with an expression, or a list of these"
)]
enum ValueEntry {
    One(NumberEntry),
    Several(Vec<NumberEntry>),
}

#[derive(Deserialize)]
#[serde(untagged, expecting = "a number or a text with an expression")]
pub(super) enum NumberEntry {
    Number(f64),
    Text(String),
}

/// Names that values and targets may have.
#[derive(Clone, Copy)]
pub(super) struct Names<'m> {
    pub textures: &'m [Texture],
    pub parameters: &'m [Parameter],
    pub convention: &'m Convention,
}

impl Names<'_> {
    /// Returns true for a parameter or a value of the convention.
    pub fn is_setting(&self, name: &str) -> bool {
        (self.parameters.iter()).any(|parameter| parameter.name == name)
            || self.convention.value(name).is_some()
    }
}

/// Reads a binding.
pub(super) fn read_binding(
    file: &File,
    spanned: &Spanned<BindingEntry>,
    names: Names,
) -> Result<Binding, FilterError> {
    let entry = spanned.get_ref();
    let refuse = |reason: String| file.at(spanned, format!("binding: {reason}"));
    let mut places = [
        entry.binding.map(|binding| BindingPlace::Bound {
            group: entry.group,
            binding,
        }),
        entry.name.clone().map(BindingPlace::Named),
        entry.push_constants.then_some(BindingPlace::PushConstants),
        entry.globals.then_some(BindingPlace::Globals),
    ]
    .into_iter()
    .flatten();
    let (Some(place), None) = (places.next(), places.next()) else {
        return Err(refuse(
            "needs one of `binding` with its number in the group, `name` of its variable, `push_constants = true` and \
             `globals = true`"
                .into(),
        ));
    };
    if let Some(name) = &entry.name {
        file.check_line(spanned, "binding: name", name)?;
    }
    if entry.values.len() > MAX_ENTRIES {
        return Err(refuse(format!("has more than {MAX_ENTRIES} values")));
    }
    let read_number = |member: &str, number: &NumberEntry| {
        read_number(number, names).map_err(|reason| refuse(format!("{member} = {reason}")))
    };
    let mut values = Vec::new();
    for (member, given) in &entry.values {
        let numbers = match given {
            ValueEntry::One(number) => vec![read_number(member, number)?],
            ValueEntry::Several(numbers) => (numbers.iter())
                .map(|number| read_number(member, number))
                .collect::<Result<_, _>>()?,
        };
        values.push((member.clone(), numbers));
    }
    Ok(Binding {
        place,
        texture: entry.texture.clone(),
        level: read_level(file, spanned, entry.level.as_ref(), names)?,
        sampling: Sampling {
            filter: entry.sampler.unwrap_or_default(),
            mip_filter: entry.mip_filter.unwrap_or(SamplerFilter::Nearest),
            wrap: entry.wrap.unwrap_or_default(),
        },
        values,
        line: file.line(spanned.span().start),
    })
}

/// Reads a value of a uniform block: a number, an expression, or the name of several numbers.
fn read_number(number: &NumberEntry, names: Names) -> Result<Expression, String> {
    let text = match number {
        NumberEntry::Number(number) if number.is_finite() => {
            return Ok(Expression::Number(*number));
        }
        NumberEntry::Number(number) => return Err(format!("{number}; allowed: finite")),
        NumberEntry::Text(text) => text,
    };
    let count = |name: &str| count_numbers(name, names.parameters, names.convention);
    if count(text.trim()).is_some() {
        return Ok(Expression::Name(text.trim().to_owned()));
    }
    if let Some(reason) = explain_unknown(text.trim()) {
        return Err(format!("\"{text}\" {reason}"));
    }
    Expression::parse(text, &|name| count(name) == Some(1)).map_err(|reason| {
        format!(
            "\"{text}\" {reason}; known names: {}; arithmetic takes one of several numbers, such as resolution[0]",
            list_values(names.parameters, names.convention)
        )
    })
}

/// Reads the mip level of a texture: a number from 0, or an expression of parameters and of the iteration.
pub(super) fn read_level<T>(
    file: &File,
    place: &Spanned<T>,
    entry: Option<&NumberEntry>,
    names: Names,
) -> Result<Option<Expression>, FilterError> {
    let Some(entry) = entry else {
        return Ok(None);
    };
    let is_known = |name: &str| names.is_setting(name) || LEVEL_VALUES.contains(&name);
    let read = match entry {
        NumberEntry::Number(level) if *level >= 0.0 && level.fract() == 0.0 => {
            Ok(Expression::Number(*level))
        }
        NumberEntry::Number(level) => Err(format!("level = {level}; allowed: whole, from 0")),
        NumberEntry::Text(text) => Expression::parse(text, &is_known).map_err(|reason| {
            format!(
                "level = \"{text}\" {reason}; known names: parameters, values of [convention], {}",
                LEVEL_VALUES.join(", ")
            )
        }),
    };
    read.map(Some).map_err(|reason| file.at(place, reason))
}

/// Names that a mip level may depend on, besides settings.
const LEVEL_VALUES: [&str; 2] = ["iteration", "iterations"];
