//! Findings about a run, in a file next to it.

use std::path::Path;

use frame::{read_bounded, write_atomically};
use measure::{Error, MAX_RUN_BYTES, PROGRAM, Run, is_below, read_text_within, to_lines};
use serde::{Deserialize, Serialize};

use crate::{Decision, Finding};

/// Version of the layout of `judgement.json`.
const JUDGEMENT_FORMAT: u32 = 1;
/// Name of the file, next to `run.json`.
pub const JUDGEMENT_FILE: &str = "judgement.json";

/// All findings about a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Judgement {
    /// Version of the layout.
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// Hash of the run's `run.json`.
    pub run: String,
    /// Verdict of the check that judged the run last; none if `run` did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Verdict>,
    /// One per bounded score, in the order of the run's cases.
    pub findings: Vec<Finding>,
}

/// Verdict of a check, as its page states it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Decision.
    pub decision: Decision,
    /// Reason; none if the check passed.
    pub reason: Option<String>,
    /// Lines about comparisons with the baseline that did not pass.
    pub comparisons: Vec<String>,
}

impl Judgement {
    /// Makes the judgement of the run in `folder` after its `run.json` is written.
    pub fn new(
        folder: &Path,
        findings: Vec<Finding>,
        verdict: Option<Verdict>,
    ) -> Result<Self, Error> {
        Ok(Self {
            format: JUDGEMENT_FORMAT,
            program: PROGRAM.to_owned(),
            run: hash_of_run(folder)?,
            verdict,
            findings,
        })
    }

    /// Writes `judgement.json` into the folder of the run.
    pub fn write(&self, folder: &Path) -> Result<(), Error> {
        let json = to_lines(self) + "\n";
        Ok(write_atomically(
            &folder.join(JUDGEMENT_FILE),
            json.as_bytes(),
        )?)
    }

    /// Reads the judgement of `run`, with its `run.json` in `folder`; none if the run was never
    /// judged. Refuses a judgement of another run, and one that names places or files elsewhere.
    pub fn read(run: &Run, folder: &Path) -> Result<Option<Self>, Error> {
        let path = folder.join(JUDGEMENT_FILE);
        if !path.exists() {
            return Ok(None);
        }
        let text = read_text_within(&path, MAX_RUN_BYTES)?;
        let refuse = |reason: String| {
            Error::Refused(format!(
                "{}: {reason}; judge the run again: shuttertruth check --run {}",
                path.display(),
                folder.join("run.json").display()
            ))
        };
        let judgement: Self = serde_json::from_str(&text)
            .map_err(|error| refuse(format!("is no judgement: {error}")))?;
        if judgement.format != JUDGEMENT_FORMAT {
            let format = judgement.format;
            let reason = format!("has format {format}; allowed: {JUDGEMENT_FORMAT}");
            return Err(refuse(reason));
        }
        if judgement.run != hash_of_run(folder)? {
            return Err(refuse("is about another run.json".to_owned()));
        }
        let mut findings = judgement.findings.iter();
        findings
            .try_for_each(|finding| check_finding(finding, run))
            .map_err(refuse)?;
        Ok(Some(judgement))
    }
}

/// Refuses a finding with a place outside the run's pictures or folder.
fn check_finding(finding: &Finding, run: &Run) -> Result<(), String> {
    match &finding.worst {
        Some(worst) if worst.x >= run.render.width || worst.y >= run.render.height => Err(format!(
            "the worst place ({}, {}) is outside {}x{} pixels",
            worst.x, worst.y, run.render.width, run.render.height
        )),
        Some(worst) if !is_below(&worst.picture) => Err(format!(
            "picture \"{}\": it has to be in a folder below run.json",
            worst.picture.display()
        )),
        _ => Ok(()),
    }
}

fn hash_of_run(folder: &Path) -> Result<String, Error> {
    let path = folder.join("run.json");
    let bytes = read_bounded(&path, MAX_RUN_BYTES)?;
    Ok(blake3::hash(&bytes).to_hex().to_string())
}
