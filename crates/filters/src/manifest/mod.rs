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
use crate::text::{unfit, without_controls};
use crate::{Filter, FilterError};
use command::{command, environment};
use parameters::{ParameterEntry, PresetEntry, parameters, presets};
use passes::{PassEntry, TextureEntry, passes, textures};
use reach::{ReachEntry, reach_by};
use time_limit::time_limit;

pub use parameters::MAX_CHOICES;
pub use passes::MAX_DISPATCHES;

/// How many parameters, presets, textures and passes a filter may have, of each.
pub const MAX_ENTRIES: usize = 256;

/// Where things are declared in `filter.toml`, for messages: lines from 1.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lines {
    pub path: PathBuf,
    pub parameters: Vec<usize>,
    pub presets: Vec<usize>,
    pub textures: Vec<usize>,
    pub passes: Vec<usize>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Manifest {
    name: Spanned<String>,
    summary: Spanned<String>,
    source: Option<Spanned<String>>,
    reach: Option<Spanned<String>>,
    reach_by: Option<Spanned<ReachEntry>>,
    cannot: Option<Spanned<String>>,
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

/// Reads `filter.toml`. The filter comes back without kernels.
pub(crate) fn read(path: &Path, text: &str) -> Result<Filter, FilterError> {
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
    file.at_most_so_many("parameter", &manifest.parameter)?;
    file.at_most_so_many("preset", &manifest.preset)?;
    file.at_most_so_many("texture", &manifest.texture)?;
    file.at_most_so_many("pass", &manifest.pass)?;
    let sentence = |name: &str, text: Option<&Spanned<String>>| match text {
        Some(text) => file.one_line(text, name, text.get_ref()),
        None => Ok(String::new()),
    };
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
        summary: sentence("summary", Some(&manifest.summary))?,
        source: sentence("source", manifest.source.as_ref())?,
        reach: sentence("reach", manifest.reach.as_ref())?,
        cannot: sentence("cannot", manifest.cannot.as_ref())?,
        alignment: manifest.alignment,
        mirror_symmetric: manifest.mirror_symmetric,
        shader: Shader::default(),
        lines: Lines {
            path: path.to_owned(),
            parameters: file.lines(&manifest.parameter),
            presets: file.lines(&manifest.preset),
            textures: file.lines(&manifest.texture),
            passes: file.lines(&manifest.pass),
        },
    };
    Ok(filter)
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
            reason: without_controls(&reason.replace('\n', "; ")),
        }
    }

    /// Refuses a text that would disturb the terminal, log or page that shows it.
    fn one_line<T>(
        &self,
        place: &Spanned<T>,
        name: &str,
        text: &str,
    ) -> Result<String, FilterError> {
        match unfit(text) {
            None => Ok(text.to_owned()),
            Some(reason) => Err(self.at(place, format!("{name} {reason}"))),
        }
    }

    fn at_most_so_many<T>(&self, kind: &str, entries: &[Spanned<T>]) -> Result<(), FilterError> {
        match entries.get(MAX_ENTRIES) {
            None => Ok(()),
            Some(first_too_many) => Err(self.at(
                first_too_many,
                format!(
                    "{} [[{kind}]]; allowed: at most {MAX_ENTRIES}; divide the filter in two",
                    entries.len()
                ),
            )),
        }
    }

    fn at<T>(&self, place: &Spanned<T>, reason: String) -> FilterError {
        self.refuse(Some(place.span().start), reason)
    }

    fn line(&self, offset: usize) -> usize {
        let before = self.text.as_bytes().iter().take(offset);
        before.filter(|byte| **byte == b'\n').count() + 1
    }

    fn lines<T>(&self, entries: &[Spanned<T>]) -> Vec<usize> {
        entries
            .iter()
            .map(|entry| self.line(entry.span().start))
            .collect()
    }
}
