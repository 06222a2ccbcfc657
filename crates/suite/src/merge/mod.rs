//! Merge of runs of which each measured some of the cases.

mod case_order;
mod checks;
mod files;
mod join;
mod order;
mod run_part;

use std::path::{Path, PathBuf};

use store::{Claim, Sharing, claim, place_files};

use self::files::gather_files;
use self::join::join_runs;
use self::run_part::RunPart;
use crate::Error;
use crate::run::Run;

/// A run that was merged.
pub struct MergedRun {
    /// The whole run; its `run.json` is not written yet.
    pub run: Run,
    /// Claim on the folder, until that file is written.
    pub claim: Claim,
}

/// Tells whether a path names a finished run: its `run.json`, or its folder.
pub fn holds_run(path: &Path) -> bool {
    path.is_file() || path.join("run.json").is_file()
}

/// Joins the runs of all `parts`, each a `run.json` or its folder, and takes their pictures into `out`. The run is the one that a
/// single process measures: its cases in the same order, the same means, and `command` as the words of its command line. Scenes
/// and filters are ordered as the parts name them first.
///
/// # Errors
/// Nothing is written if the parts differ in their settings, adapters or truths, if two hold one case with other scores, or if
/// cases are missing.
pub fn merge_runs(parts: &[PathBuf], command: Vec<String>, out: &Path) -> Result<MergedRun, Error> {
    let parts: Vec<RunPart> = parts
        .iter()
        .map(|path| RunPart::read(path))
        .collect::<Result<_, _>>()?;
    let run = Run {
        command,
        ..join_runs(&parts)?
    };
    let files = gather_files(&parts)?;
    let claim = claim(out, [], Sharing::Alone)?;
    place_files(&files, out)?;
    Ok(MergedRun { run, claim })
}
