//! Files of runs that are joined.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use frame::{Alignment, FileError, read_bounded};

use super::run_part::RunPart;
use crate::Error;
use crate::folder::placed_file::{MOST_TAKEN_BYTES, is_one_file, place_file};
use crate::measure::pictures::{CASE_FILES, FRAME_FILES, truth_files};
use crate::render::ladders::ladder_folder;
use crate::render::replicates::replicates_folder;
use crate::run::Run;

/// The source of each file, by its path below the parts.
pub(super) type Files = BTreeMap<PathBuf, PathBuf>;

/// Lists the files of all cases and their scenes. A file that two parts hold must be the same in both, and no picture may be missing from
/// all. Follows no links.
pub(super) fn gather_files(parts: &[RunPart]) -> Result<Files, Error> {
    let mut files = Files::new();
    for part in parts {
        for below in list_folders(part) {
            for name in list_files(&part.folder.join(&below))? {
                let below = below.join(name);
                let file = part.folder.join(&below);
                match files.get(&below) {
                    Some(other) => check_same(other, &file)?,
                    None => {
                        files.insert(below, file);
                    }
                }
            }
        }
    }
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

/// Places all files below a folder.
pub(super) fn place_files(files: &Files, out: &Path) -> Result<(), Error> {
    for (below, file) in files {
        place_file(file, &out.join(below))?;
    }
    Ok(())
}

/// Lists the folders of a run's cases, of its scenes, and of their replicates and ladders, relative to `run.json`.
fn list_folders(part: &RunPart) -> BTreeSet<PathBuf> {
    let mut folders: BTreeSet<PathBuf> = BTreeSet::new();
    for (scene, case, _) in list_cases(&part.run) {
        for alignment in Alignment::ALL {
            folders.insert(replicates_folder(&scene, alignment));
            folders.insert(scene.join(ladder_folder(alignment)));
        }
        folders.extend([scene, case.to_owned()]);
    }
    folders
}

/// Lists the names of regular files in a folder; none where there is no such folder, or a link to one.
fn list_files(folder: &Path) -> Result<Vec<PathBuf>, Error> {
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

/// Refuses two files of one name with other bytes.
fn check_same(one: &Path, other: &Path) -> Result<(), Error> {
    let read = |path: &Path| read_bounded(path, MOST_TAKEN_BYTES);
    if is_one_file(one, other) || read(one)? == read(other)? {
        return Ok(());
    }
    Err(Error::Usage(format!(
        "{} and {} differ; parts of one run come from one build of the program, one version of the scenes, and the same settings",
        one.display(),
        other.display()
    )))
}
