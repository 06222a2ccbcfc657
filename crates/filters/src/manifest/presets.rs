//! `[[preset]]` of filter.toml.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use super::file::File;
use super::number::{IDENTIFIER, is_identifier};
use super::parameters::read_value;
use super::source::{SourceEntry, read_source};
use crate::{FilterError, Parameter, Preset, TuningRecord};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PresetEntry {
    name: String,
    doc: String,
    #[serde(default)]
    values: BTreeMap<String, Spanned<toml::Value>>,
    source: Option<Spanned<SourceEntry>>,
    reference_width: Option<Spanned<u32>>,
    tuned: Option<TuningRecord>,
}

/// Reads every preset; a filter without any gets one with every parameter at its default.
/// `reference_width` is the filter's, for presets without one of their own.
pub(super) fn read_presets(
    file: &File,
    entries: &[Spanned<PresetEntry>],
    parameters: &[Parameter],
    reference_width: Option<&Spanned<u32>>,
) -> Result<Vec<Preset>, FilterError> {
    let of_filter = read_reference_width(file, "", reference_width, parameters)?;
    let mut presets = Vec::<Preset>::new();
    for spanned in entries {
        let preset = read_preset(file, spanned, parameters, of_filter)?;
        let is_known = |name: &String| presets.iter().any(|known| known.name == *name);
        if is_known(&preset.name) {
            let reason = format!("preset \"{}\": no two presets share a name", preset.name);
            return Err(file.at(spanned, reason));
        }
        let from = preset.tuned.as_ref().map(|tuned| &tuned.from);
        if let Some(from) = from.filter(|from| !is_known(from)) {
            let reason = format!(
                "preset \"{}\": tuned from \"{from}\", which is no preset before it",
                preset.name
            );
            return Err(file.at(spanned, reason));
        }
        presets.push(preset);
    }
    if presets.is_empty() {
        presets.push(Preset {
            name: "default".into(),
            doc: "Every parameter at its default.".into(),
            source: None,
            reference_width: of_filter,
            values: BTreeMap::new(),
            tuned: None,
        });
    }
    Ok(presets)
}

fn read_preset(
    file: &File,
    spanned: &Spanned<PresetEntry>,
    parameters: &[Parameter],
    of_filter: Option<u32>,
) -> Result<Preset, FilterError> {
    let entry = spanned.get_ref();
    let named = |reason: &str| format!("preset \"{}\": {reason}", entry.name);
    if !is_identifier(&entry.name) {
        return Err(file.at(spanned, named(IDENTIFIER)));
    }
    let doc = file.check_line(spanned, &named("doc"), &entry.doc)?;
    if let Some(tuned) = &entry.tuned {
        for text in [&tuned.by, &tuned.from].into_iter().chain(&tuned.scenes) {
            file.check_line(spanned, &named("tuned"), text)?;
        }
    }
    let mut values = BTreeMap::new();
    for (name, given) in &entry.values {
        let refuse = |reason: String| file.at(given, named(&format!("{name} {reason}")));
        let parameter = (parameters.iter())
            .find(|parameter| parameter.name == *name)
            .ok_or_else(|| refuse("is no parameter of this filter".into()))?;
        let value = read_value(&parameter.kind, given.get_ref()).ok_or_else(|| {
            let allowed = parameter.kind.allowed();
            refuse(format!("= {} is not {allowed}", given.get_ref()))
        })?;
        values.insert(name.clone(), value);
    }
    let width = entry.reference_width.as_ref();
    let width = read_reference_width(file, &named(""), width, parameters)?;
    Ok(Preset {
        name: entry.name.clone(),
        doc,
        source: read_source(file, &entry.name, entry.source.as_ref())?,
        reference_width: width.or(of_filter),
        values,
        tuned: entry.tuned.clone(),
    })
}

/// Reads the width that a filter or a preset was made for, which `named` names; refuses one that
/// changes no parameter.
fn read_reference_width(
    file: &File,
    named: &str,
    entry: Option<&Spanned<u32>>,
    parameters: &[Parameter],
) -> Result<Option<u32>, FilterError> {
    let Some(spanned) = entry else {
        return Ok(None);
    };
    let width = *spanned.get_ref();
    let refuse =
        |reason: &str| file.at(spanned, format!("{named}reference_width = {width}{reason}"));
    if width == 0 {
        return Err(refuse("; allowed: 1 pixel or more"));
    }
    if parameters.iter().all(|parameter| parameter.unit.is_none()) {
        return Err(refuse(
            ", but no parameter has unit = \"pixels\", so that there is nothing to scale; leave it out",
        ));
    }
    Ok(Some(width))
}
