//! Parser of `filter.toml`, up to a filter without kernels.

use std::path::Path;

use frame::Alignment;
use serde::Deserialize;
use toml::Spanned;

use super::command::{add_environment, read_command};
use super::convention::read_convention;
use super::file::{File, IDENTIFIER, is_identifier};
use super::parameters::{ParameterEntry, read_parameters};
use super::passes::{PassEntry, TextureEntry, read_passes, read_textures};
use super::presets::{PresetEntry, read_presets};
use super::reach_by::{ReachEntry, read_reach_by};
use super::time_limit::read_time_limit;
use crate::filter::{History, Lines};
use crate::{Convention, Filter, FilterError};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Manifest {
    name: Spanned<String>,
    summary: Spanned<String>,
    source: Option<Spanned<String>>,
    reach: Option<Spanned<String>>,
    reach_by: Option<Spanned<ReachEntry>>,
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
    let manifest: Manifest = toml::from_str(text).map_err(|error| {
        let start = error.span().map(|span| span.start);
        file.refuse(start, error.message().to_owned())
    })?;
    let name = manifest.name.get_ref();
    if !is_identifier(name) {
        return Err(file.at(
            &manifest.name,
            format!("name \"{name}\": {IDENTIFIER}; it also names the WGSL file"),
        ));
    }
    check_method(&file, &manifest)?;
    file.check_number("parameter", &manifest.parameter)?;
    file.check_number("preset", &manifest.preset)?;
    file.check_number("texture", &manifest.texture)?;
    file.check_number("pass", &manifest.pass)?;
    let check_sentence = |name: &str, text: Option<&Spanned<String>>| match text {
        Some(text) => file.check_line(text, name, text.get_ref()),
        None => Ok(String::new()),
    };
    let parameters = read_parameters(&file, &manifest.parameter)?;
    let command = (manifest.command.as_ref())
        .map(|words| read_command(&file, words, &parameters))
        .transpose()?;
    let command = add_environment(&file, manifest.environment.as_ref(), command)?;
    let textures = read_textures(&file, &manifest.texture, &parameters)?;
    let convention = read_convention(
        &file,
        manifest.convention.as_ref(),
        manifest.command.is_some(),
    )?;
    Ok(Filter {
        name: name.clone(),
        presets: read_presets(
            &file,
            &manifest.preset,
            &parameters,
            manifest.reference_width.as_ref(),
        )?,
        passes: read_passes(&file, &manifest.pass, &textures, &parameters, &convention)?,
        convention,
        history: read_history(&file, &manifest)?,
        command,
        time_limit: read_time_limit(&file, manifest.time_limit.as_ref())?,
        reach_by: read_reach_by(&file, manifest.reach_by.as_ref(), &parameters)?,
        textures,
        parameters,
        summary: check_sentence("summary", Some(&manifest.summary))?,
        source: check_sentence("source", manifest.source.as_ref())?,
        reach: check_sentence("reach", manifest.reach.as_ref())?,
        cannot: check_sentence("cannot", manifest.cannot.as_ref())?,
        alignment: manifest.alignment,
        mirror_symmetric: manifest.mirror_symmetric,
        shaders: Vec::new(),
        lines: Lines {
            path: path.to_owned(),
            parameters: file.lines(&manifest.parameter),
            presets: file.lines(&manifest.preset),
            textures: file.lines(&manifest.texture),
            passes: file.lines(&manifest.pass),
        },
    })
}

/// Reads the inputs of the frame before, each of which may stand once. A program gets none of them.
fn read_history(file: &File, manifest: &Manifest) -> Result<Vec<History>, FilterError> {
    let mut history = Vec::new();
    for own in &manifest.history {
        if manifest.command.is_some() {
            let reason =
                "history: allowed for filters with kernels; a program keeps what it saw itself";
            return Err(file.at(own, reason.into()));
        }
        if history.contains(own.get_ref()) {
            let reason = format!(
                "history names \"{}\" twice; allowed: once",
                own.get_ref().input()
            );
            return Err(file.at(own, reason));
        }
        history.push(*own.get_ref());
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
