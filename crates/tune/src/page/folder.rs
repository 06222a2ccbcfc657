//! Files of `tune` in its folder.

use std::path::{Path, PathBuf};

use measure::{Error, read_text};
use serde::de::DeserializeOwned;

use crate::journal::read_journal;
use crate::sensitivity::Sensitivity;
use crate::trial::{JournalHeader, Trial};
use crate::tuning::{TUNE_FORMAT, Tuning};

/// Contents of tune.json, journal.jsonl and sensitivity.json; at least one exists.
#[derive(Clone, Debug)]
pub struct TuneFolder {
    /// The folder.
    pub path: PathBuf,
    /// Outcome; none for an unfinished tuning, or for a study of sensitivity alone.
    pub tuning: Option<Tuning>,
    /// The journal's first line.
    pub header: Option<JournalHeader>,
    /// The journal's complete lines after the first.
    pub trials: Vec<Trial>,
    /// Result of `sensitivity`.
    pub sensitivity: Option<Sensitivity>,
}

impl TuneFolder {
    /// Reads a folder that `tune --out` wrote; refuses files of another version, and a folder
    /// without any.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let (header, trials) = match read_journal(&path.join("journal.jsonl"))? {
            Some((header, trials)) => (Some(header), trials),
            None => (None, Vec::new()),
        };
        let tuning_path = path.join("tune.json");
        let tuning: Option<Tuning> = read_json(&tuning_path)?;
        if let Some(format) = tuning.as_ref().map(|tuning| tuning.format)
            && format != TUNE_FORMAT
        {
            return Err(Error::Refused(format!(
                "{}: has format {format}; allowed: {TUNE_FORMAT}; tune anew with this version",
                tuning_path.display()
            )));
        }
        let sensitivity = read_json(&path.join("sensitivity.json"))?;
        if header.is_none() && sensitivity.is_none() {
            return Err(Error::Refused(format!(
                "{}: holds neither a run.json nor a journal.jsonl or sensitivity.json; `shuttertruth run` and `tune` write \
                 such folders",
                path.display()
            )));
        }
        Ok(Self {
            path: path.to_owned(),
            header,
            trials,
            tuning,
            sensitivity,
        })
    }
}

/// Reads a file of JSON; none if there is no such file.
fn read_json<T: DeserializeOwned>(path: &Path) -> Result<Option<T>, Error> {
    if !path.exists() {
        return Ok(None);
    }
    let parsed = serde_json::from_str(&read_text(path)?).map_err(|error| {
        Error::Refused(format!(
            "{}: not of this program: {error}; `shuttertruth tune search` writes it anew into another folder",
            path.display()
        ))
    })?;
    Ok(Some(parsed))
}
