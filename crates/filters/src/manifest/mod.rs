//! `filter.toml`: from text to a [`Filter`] without kernels.

mod command;
mod parameters;
mod passes;
mod reach;
mod source;
mod time_limit;

use std::path::{Path, PathBuf};
use std::str::FromStr;

use frame::Alignment;
use serde::{Deserialize, Deserializer, de::Error};
use toml::Spanned;

use crate::gpu::Shader;
use crate::{Filter, FilterError};
use command::{command, environment};
use parameters::{ParameterEntry, PresetEntry, parameters, presets};
use passes::{PassEntry, TextureEntry, passes, textures};
use reach::{ReachEntry, reach_by};
use time_limit::time_limit;

/// Where things are declared in `filter.toml`, for messages: lines from 1.
pub(crate) struct Lines {
    pub path: PathBuf,
    pub parameters: Vec<usize>,
    pub textures: Vec<usize>,
    pub passes: Vec<usize>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Manifest {
    name: Spanned<String>,
    summary: String,
    #[serde(default)]
    source: String,
    #[serde(default)]
    reach: String,
    reach_by: Option<Spanned<ReachEntry>>,
    #[serde(default)]
    cannot: String,
    #[serde(deserialize_with = "alignment")]
    alignment: Alignment,
    #[serde(default)]
    mirror_symmetric: bool,
    #[serde(default)]
    parameter: Vec<Spanned<ParameterEntry>>,
    #[serde(default)]
    preset: Vec<Spanned<PresetEntry>>,
    command: Option<Spanned<Vec<String>>>,
    environment: Option<Spanned<Vec<String>>>,
    time_limit: Option<Spanned<f64>>,
    #[serde(default)]
    texture: Vec<Spanned<TextureEntry>>,
    #[serde(default)]
    pass: Vec<Spanned<PassEntry>>,
}

fn alignment<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Alignment, D::Error> {
    Alignment::from_str(&String::deserialize(deserializer)?).map_err(D::Error::custom)
}

/// Reads `filter.toml`. The filter comes back without kernels, and the lines of its declarations beside it.
pub(crate) fn read(path: &Path, text: &str) -> Result<(Filter, Lines), FilterError> {
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
    let parameters = parameters(&file, &manifest.parameter)?;
    let command = (manifest.command.as_ref())
        .map(|words| command(&file, words, &parameters))
        .transpose()?;
    let command = environment(&file, manifest.environment.as_ref(), command)?;
    let textures = textures(&file, &manifest.texture, &parameters)?;
    let filter = Filter {
        name: name.clone(),
        presets: presets(&file, &manifest.preset, &parameters)?,
        passes: passes(&file, &manifest.pass, &textures, &parameters)?,
        command,
        time_limit: time_limit(&file, manifest.time_limit.as_ref())?,
        reach_by: reach_by(&file, manifest.reach_by.as_ref(), &parameters)?,
        textures,
        parameters,
        summary: manifest.summary,
        source: manifest.source,
        reach: manifest.reach,
        cannot: manifest.cannot,
        alignment: manifest.alignment,
        mirror_symmetric: manifest.mirror_symmetric,
        shader: Shader::default(),
    };
    let lines = Lines {
        path: path.to_owned(),
        parameters: file.lines(&manifest.parameter),
        textures: file.lines(&manifest.texture),
        passes: file.lines(&manifest.pass),
    };
    Ok((filter, lines))
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

const IDENTIFIER: &str = "a name is made of a-z, 0-9 and _, and begins with a letter";

fn is_identifier(name: &str) -> bool {
    name.starts_with(|first: char| first.is_ascii_lowercase())
        && name
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
}

struct File<'a> {
    path: &'a Path,
    text: &'a str,
}

impl File<'_> {
    fn refuse(&self, offset: Option<usize>, reason: String) -> FilterError {
        FilterError::Folder {
            path: self.path.to_owned(),
            line: offset.map(|offset| self.line(offset)),
            reason,
        }
    }

    fn at<T>(&self, place: &Spanned<T>, reason: String) -> FilterError {
        self.refuse(Some(place.span().start), reason)
    }

    fn line(&self, offset: usize) -> usize {
        self.text[..offset].matches('\n').count() + 1
    }

    fn lines<T>(&self, entries: &[Spanned<T>]) -> Vec<usize> {
        entries
            .iter()
            .map(|entry| self.line(entry.span().start))
            .collect()
    }
}
