//! Files that describe a finished run: run.json and the judgement of it.

use std::path::Path;

use judge::{Finding, Judgement};
use suite::{Error, Run};

/// Writes `run.json` and returns its text.
pub fn write_run(run: &Run, out: &Path) -> Result<String, Error> {
    let json = run.text();
    frame::write_atomically(&out.join("run.json"), json.as_bytes())?;
    Ok(json)
}

/// Writes `run.json` and the findings about it; returns the text of `run.json`.
pub fn write_judged_run(run: &Run, findings: &[Finding], out: &Path) -> Result<String, Error> {
    let json = write_run(run, out)?;
    Judgement::new(out, findings.to_vec())?.write(out)?;
    Ok(json)
}
