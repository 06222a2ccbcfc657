//! Findings as a file beside the run that they are about.

use std::path::Path;

use frame::{read_bounded, write_atomically};
use metrics::Metric;
use serde::{Deserialize, Serialize};

use super::Finding;
use crate::json_file::{MOST_JSON_BYTES, read_text};
use crate::{Error, PROGRAM};

/// Version of the layout of `judgement.json`.
pub const JUDGEMENT_FORMAT: u32 = 1;
/// Name of the file, beside `run.json`.
pub const JUDGEMENT_FILE: &str = "judgement.json";

/// All findings about a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Judgement {
    /// [`JUDGEMENT_FORMAT`].
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// Hash of the run's `run.json`.
    pub run: String,
    /// One per bounded score, in the order of the run's cases.
    pub findings: Vec<Finding>,
}

impl Judgement {
    /// Findings about the run in `folder`, whose `run.json` is written.
    pub fn new(folder: &Path, findings: Vec<Finding>) -> Result<Self, Error> {
        Ok(Self {
            format: JUDGEMENT_FORMAT,
            program: PROGRAM.to_owned(),
            run: hash_of_run(folder)?,
            findings,
        })
    }

    /// Writes `judgement.json` into the folder of the run.
    pub fn write(&self, folder: &Path) -> Result<(), Error> {
        let json = serde_json::to_string_pretty(self).expect("a judgement is plain data");
        Ok(write_atomically(
            &folder.join(JUDGEMENT_FILE),
            (json + "\n").as_bytes(),
        )?)
    }

    /// Reads the judgement of the run in `folder`; none where the run was never judged. A judgement of another run is refused.
    pub fn read(folder: &Path) -> Result<Option<Self>, Error> {
        let path = folder.join(JUDGEMENT_FILE);
        if !path.exists() {
            return Ok(None);
        }
        let text = std::fs::read_to_string(&path)
            .map_err(|source| FileError::io(&path, "read", source))?;
        let refuse = |reason: String| {
            Err(Error::Usage(format!(
                "{}: {reason}; judge the run again: shuttertruth check {}",
                path.display(),
                folder.join("run.json").display()
            )))
        };
        let judgement: Self = match serde_json::from_str(&text) {
            Ok(judgement) => judgement,
            Err(error) => return refuse(format!("is no judgement: {error}")),
        };
        if judgement.format != JUDGEMENT_FORMAT {
            let found = judgement.format;
            return refuse(format!("has format {found}; allowed: {JUDGEMENT_FORMAT}"));
        }
        if judgement.run != hash_of_run(folder)? {
            return refuse("is about another run.json".to_owned());
        }
        let unknown =
            (judgement.findings.iter()).find_map(|finding| finding.metric.parse::<Metric>().err());
        match unknown {
            Some(error) => refuse(error),
            None => Ok(Some(judgement)),
        }
    }
}

fn hash_of_run(folder: &Path) -> Result<String, Error> {
    let path = folder.join("run.json");
    let bytes = read_bounded(&path, MOST_JSON_BYTES)?;
    Ok(blake3::hash(&bytes).to_hex().to_string())
}
