//! Parser of `filter.toml`, up to a filter without kernels.

use std::path::Path;

use frame::Alignment;
use serde::Deserialize;
use toml::Spanned;

use super::command::read_command;
use super::convention::{check_origin, read_convention};
use super::file::File;
use super::number::{IDENTIFIER, is_identifier};
use super::parameters::{ParameterEntry, read_parameters};
use super::pass_shader::PassEntry;
use super::passes::{TextureEntry, read_passes, read_textures};
use super::presets::{PresetEntry, read_presets};
use crate::filter::{DEFAULT_TIME_LIMIT, History, Lines};
use crate::{Convention, Filter, FilterError, ReachBy};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Manifest {
    name: Spanned<String>,
    summary: Spanned<String>,
    source: Option<Spanned<String>>,
    reach: Option<Spanned<String>>,
    reach_by: Option<Spanned<ReachBy>>,
    cannot: Option<Spanned<String>>,
    alignment: Alignment,
    #[serde(default)]
    mirror_symmetric: bool,
    reference_width: Option<Spanned<u32>>,
    #[serde(default)]
    parameter: Vec<Spanned<ParameterEntry>>,
    #[serde(default)]
    preset: Vec<Spanned<PresetEntry>>,
    command: Option<Spanned<Vec<String>>>,
    environment: Option<Spanned<Vec<String>>>,
    time_limit: Option<Spanned<f64>>,
    convention: Option<Spanned<Convention>>,
    #[serde(default)]
    history: Vec<Spanned<History>>,
    #[serde(default)]
    texture: Vec<Spanned<TextureEntry>>,
    #[serde(default)]
    pass: Vec<Spanned<PassEntry>>,
}

/// Parses `filter.toml` into a filter that still lacks its kernels.
pub(crate) fn parse(path: &Path, text: &str) -> Result<Filter, FilterError> {
    let file = File { path, text };
    let manifest: Manifest = file.read("")?;
    let name = manifest.name.get_ref();
    if !is_identifier(name) {
        let reason = format!("name \"{name}\": {IDENTIFIER}; it also names the WGSL file");
        return Err(file.at(&manifest.name, reason));
    }
    check_method(&file, &manifest)?;
    let lines = Lines {
        path: path.to_owned(),
        parameters: file.lines("parameter", &manifest.parameter)?,
        presets: file.lines("preset", &manifest.preset)?,
        textures: file.lines("texture", &manifest.texture)?,
        passes: file.lines("pass", &manifest.pass)?,
    };
    let check_sentence = |name: &str, text: Option<&Spanned<String>>| {
        text.map_or(Ok(String::new()), |text| {
            file.check_line(text, name, text.get_ref())
        })
    };
    let parameters = read_parameters(&file, &manifest.parameter)?;
    let (words, variables) = (manifest.command.as_ref(), manifest.environment.as_ref());
    let command = read_command(&file, words, variables, &parameters)?;
    let width = manifest.reference_width.as_ref();
    let mut filter = Filter {
        name: name.clone(),
        folder: None,
        summary: check_sentence("summary", Some(&manifest.summary))?,
        source: check_sentence("source", manifest.source.as_ref())?,
        reach: check_sentence("reach", manifest.reach.as_ref())?,
        cannot: check_sentence("cannot", manifest.cannot.as_ref())?,
        alignment: manifest.alignment,
        mirror_symmetric: manifest.mirror_symmetric,
        convention: read_convention(&file, manifest.convention.as_ref(), command.is_some())?,
        history: read_history(&file, &manifest)?,
        command,
        time_limit: read_time_limit(&file, manifest.time_limit.as_ref())?,
        presets: read_presets(&file, &manifest.preset, &parameters, width)?,
        parameters,
        reach_by: None,
        textures: Vec::new(),
        passes: Vec::new(),
        shaders: Vec::new(),
        content_hash: String::new(),
        lines,
    };
    if let Some(reach_by) = &manifest.reach_by {
        check_reach_by(&file, reach_by, &filter)?;
    }
    filter.reach_by = manifest.reach_by.map(Spanned::into_inner);
    filter.textures = read_textures(&file, &manifest.texture, &filter)?;
    filter.passes = read_passes(&file, &manifest.pass, &filter)?;
    check_origin(&file, manifest.convention.as_ref(), &filter)?;
    Ok(filter)
}

/// Refuses a reach that does not come from integer parameters.
fn check_reach_by(
    file: &File,
    spanned: &Spanned<ReachBy>,
    filter: &Filter,
) -> Result<(), FilterError> {
    let ReachBy {
        parameter, unit, ..
    } = spanned.get_ref();
    let unit = filter.find_largest(unit);
    filter
        .check_parameter(parameter)
        .map_err(|reason| format!("parameter = {reason}"))
        .and(unit.map_err(|reason| format!("unit = {reason}")))
        .map(|_| ())
        .map_err(|reason| file.at(spanned, format!("reach_by: {reason}")))
}

/// Reads the seconds that one run of a program, or one pass of kernels, may take: at most a day.
fn read_time_limit(file: &File, limit: Option<&Spanned<f64>>) -> Result<f64, FilterError> {
    let longest = 86_400.0;
    let Some(spanned) = limit else {
        return Ok(DEFAULT_TIME_LIMIT);
    };
    match *spanned.get_ref() {
        limit if limit > 0.0 && limit <= longest => Ok(limit),
        limit => Err(file.at(
            spanned,
            format!("time_limit = {limit}; allowed: seconds, above 0 and at most {longest}"),
        )),
    }
}

/// Reads the inputs of the frame before, each at most once. A program gets none of them.
fn read_history(file: &File, manifest: &Manifest) -> Result<Vec<History>, FilterError> {
    let mut history = Vec::new();
    for entry in &manifest.history {
        if manifest.command.is_some() {
            let reason =
                "history: allowed for filters with kernels; a program keeps what it saw itself";
            return Err(file.at(entry, reason.into()));
        }
        if history.contains(entry.get_ref()) {
            let reason = format!(
                "history names \"{}\" twice; allowed: once",
                entry.get_ref().layer().name()
            );
            return Err(file.at(entry, reason));
        }
        history.push(*entry.get_ref());
    }
    Ok(history)
}

/// Refuses a filter that is neither a command nor passes over kernels, or both.
fn check_method(file: &File, manifest: &Manifest) -> Result<(), FilterError> {
    let Manifest {
        command,
        pass,
        texture,
        ..
    } = manifest;
    let kernels = pass.first().map(Spanned::span);
    let kernels = kernels.or(texture.first().map(Spanned::span));
    match (command, kernels) {
        (Some(_), Some(place)) => Err(file.refuse(
            Some(place.start),
            "a filter that is a command has neither [[pass]] nor [[texture]]".into(),
        )),
        (None, _) if pass.is_empty() => Err(file.refuse(
            None,
            "has neither a [[pass]] nor a command; one of them is needed".into(),
        )),
        _ => Ok(()),
    }
}
