//! The pictures of runs that are joined.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use frame::{Alignment, FileError};
use store::{Files, gather, list_renders};

use super::run_part::RunPart;
use crate::Error;
use crate::measure::pictures::{CASE_FILES, FRAME_FILES, truth_files};
use crate::run::Run;

/// Gathers the files of all cases and their scenes. A file that two parts hold must be the same in both, and no picture may be missing
/// from all. Follows no links.
pub(super) fn gather_files(parts: &[RunPart]) -> Result<Files, Error> {
    let lists = parts
        .iter()
        .map(|part| Ok((&*part.folder, list_files(part)?)));
    let files = gather(lists.collect::<Result<Vec<_>, Error>>()?)?;
    parts
        .iter()
        .try_for_each(|part| check_pictures(part, &files))?;
    Ok(files)
}

/// Refuses a part with a case whose pictures, or those of its scene, no part holds.
fn check_pictures(part: &RunPart, files: &Files) -> Result<(), Error> {
    for (scene, case, alignment) in list_cases(&part.run) {
        let own = CASE_FILES.iter().map(|name| case.join(name));
        let of_scene = FRAME_FILES.iter().map(|name| scene.join(name));
        let of_truth = truth_files(alignment).map(|name| scene.join(name));
        let mut all = own.chain(of_scene).chain(of_truth);
        if let Some(missing) = all.find(|below| !files.contains_key(below)) {
            return Err(Error::Usage(format!(
                "{}: no part holds {}, or it is a link; copy the folders of runs as a whole, or measure that case again",
                part.file(),
                missing.display()
            )));
        }
    }
    Ok(())
}

/// Lists the cases of a run, and of all frames of its sequences, each as the folder of its scene, its own folder, and its shutter.
fn list_cases(run: &Run) -> impl Iterator<Item = (PathBuf, &Path, Alignment)> {
    let cases = (run.cases.iter()).map(|case| (case.scene.folder(), &*case.folder, case.alignment));
    let frames = run.sequences.iter().flat_map(|sequence| {
        let frames = sequence.frames.iter();
        frames.map(|frame| (frame.scene.clone(), &*frame.folder, sequence.alignment))
    });
    cases.chain(frames)
}

/// Lists the files of a run's scenes and cases, and those that were rendered for them, relative to `run.json`.
fn list_files(part: &RunPart) -> Result<Vec<PathBuf>, Error> {
    let mut folders: BTreeSet<PathBuf> = BTreeSet::new();
    for (scene, case, _) in list_cases(&part.run) {
        folders.extend([scene, case.to_owned()]);
    }
    let mut files: BTreeSet<PathBuf> = (list_renders(&part.folder)?.into_iter())
        .filter(|render| folders.contains(&render.scene.folder()))
        .map(|render| render.path())
        .collect();
    for below in &folders {
        let names = list_names(&part.folder.join(below))?.into_iter();
        files.extend(names.map(|name| below.join(name)));
    }
    Ok(files.into_iter().collect())
}

/// Lists the names of regular files in a folder; none where there is no such folder, or a link to one.
fn list_names(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    if !fs::symlink_metadata(folder).is_ok_and(|found| found.is_dir()) {
        return Ok(Vec::new());
    }
    let fail = |source| FileError::io(folder, "read", source);
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(fail)? {
        let entry = entry.map_err(fail)?;
        let name = entry.file_name();
        // What a killed process was writing.
        let is_leftover = name.to_string_lossy().starts_with('.');
        if entry.file_type().map_err(fail)?.is_file() && !is_leftover {
            names.push(PathBuf::from(name));
        }
    }
    Ok(names)
}
