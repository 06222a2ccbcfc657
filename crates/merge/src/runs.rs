//! Runs of several machines folded into one.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use frame::Alignment;
use measure::{Error, FilterId, FolderLock, Run, Sharing, StoredRun, fold_runs, lock_folder};
use scene::SceneId;

use crate::files::gather_files;
use crate::gather::place_files;

/// Returns whether a path names a finished run: its `run.json`, or its folder.
pub fn holds_run(path: &Path) -> bool {
    path.is_file() || path.join("run.json").is_file()
}

/// Joins the runs of all `parts`, each a `run.json` or its folder, and copies their pictures into
/// `out`. The result equals a single process's run: its cases in the same order, the same means,
/// and `command` as the words of its command line. Scenes and filters keep the order in which the
/// parts first name them. Its `run.json` is not written yet, and the folder is locked until it is.
///
/// # Errors
/// Nothing is written if the parts differ in their settings, adapters or truths, if two have
/// different scores for one case, or if cases are missing.
pub fn merge_runs(
    parts: &[PathBuf],
    command: Vec<String>,
    out: &Path,
) -> Result<(Run, FolderLock), Error> {
    let parts: Vec<StoredRun> = (parts.iter())
        .map(|path| StoredRun::read(path))
        .collect::<Result<_, _>>()?;
    let run = Run {
        command,
        ..fold_runs(&parts)?
    };
    check_complete(&run)?;
    let files = gather_files(&parts)?;
    let lock = lock_folder(out, [], Sharing::Alone)?;
    place_files(&files, out)?;
    Ok((run, lock))
}

/// Refuses cases that no process could have measured together: scenes with different filters, and
/// shutters without references.
fn check_complete(run: &Run) -> Result<(), Error> {
    // An engine's scene has one shutter, and leaves out filters of others.
    let rendered = || run.cases.iter().filter(|case| case.drawn.is_none());
    let scenes: BTreeSet<&SceneId> = rendered().map(|case| &case.scene).collect();
    let filters: BTreeSet<FilterId> = rendered().map(|case| case.filter_id()).collect();
    let (references, choices): (Vec<_>, Vec<_>) =
        filters.iter().partition(|filter| filter.is_reference);
    let mut shutters: BTreeSet<Alignment> = choices.iter().map(|filter| filter.alignment).collect();
    shutters.extend((!filters.is_empty()).then_some(run.common_alignment));
    let has_references = |shutter: &&Alignment| {
        references
            .iter()
            .any(|reference| reference.alignment == **shutter)
    };
    if let Some(missing) = shutters.iter().find(|shutter| !has_references(shutter)) {
        return Err(Error::Refused(format!(
            "no part holds the references of the {missing} shutter; add the part with the references, measured with the same \
             filters"
        )));
    }
    let failed = (run.failures.iter()).map(|failure| (&failure.scene, failure.filter_id()));
    let measured = rendered().map(|case| (&case.scene, case.filter_id()));
    let pairs: BTreeSet<(&SceneId, FilterId)> = measured.chain(failed).collect();
    for scene in scenes {
        let missing = (filters.iter()).find(|filter| !pairs.contains(&(scene, (*filter).clone())));
        if let Some(missing) = missing {
            return Err(Error::Refused(format!(
                "no part holds {scene} / {} ({} shutter), which other scenes have; add the part that measured it",
                missing.name, missing.alignment
            )));
        }
    }
    Ok(())
}
