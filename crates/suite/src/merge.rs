//! Joins what several machines rendered to what one would have written.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use frame::{FileError, Replicate, Truth, write_atomically};

use crate::Error;
use crate::claim::{Sharing, claim};
use crate::replicates::replicates_folder;

/// A truth that was made whole.
#[derive(Clone, Debug, PartialEq)]
pub struct Merged {
    /// Its file.
    pub truth: PathBuf,
    /// How many replicates it is the mean of.
    pub replicates: usize,
}

/// Where each file of the parts comes from, by its path below them.
type Files = BTreeMap<PathBuf, PathBuf>;

/// Copies frames and replicates of all `parts` into `out` and makes their truths. The same file may stand in several
/// parts if its bytes are equal. Nothing is written unless every truth is whole.
pub fn merge(parts: &[PathBuf], out: &Path) -> Result<Vec<Merged>, Error> {
    let files = gather(parts)?;
    let truths = truths(&files)?;
    let _claim = claim(out, [], Sharing::Together)?;
    for (below, file) in &files {
        write_atomically(&out.join(below), &read(file)?)?;
    }
    (truths.into_iter())
        .map(|(folder, (truth, replicates))| {
            let path = out.join(folder).with_extension("exr");
            truth.write(&path)?;
            Ok(Merged {
                truth: path,
                replicates,
            })
        })
        .collect()
}

/// Every frame and replicate of all parts.
fn gather(parts: &[PathBuf]) -> Result<Files, Error> {
    let mut files = Files::new();
    for part in parts {
        let before = files.len();
        for file in files_below(part)? {
            let below = file
                .strip_prefix(part)
                .expect("the file lies below the part")
                .to_owned();
            if !is_rendered(&below) {
                continue;
            }
            if let Some(other) = files.get(&below)
                && read(other)? != read(&file)?
            {
                return Err(Error::Usage(format!(
                    "{} and {} differ; parts of one truth come from one version of the program, scene and settings, on \
                     one kind of processor",
                    other.display(),
                    file.display()
                )));
            }
            files.entry(below).or_insert(file);
        }
        if files.len() == before && !files_below(part)?.iter().any(|file| is_rendered(file)) {
            return Err(Error::Usage(format!(
                "{}: holds no replicates; allowed: folders that `shuttertruth render --replicates A..B --out` wrote",
                part.display()
            )));
        }
    }
    Ok(files)
}

/// The truth of each folder of replicates.
fn truths(files: &Files) -> Result<BTreeMap<PathBuf, (Truth, usize)>, Error> {
    let mut folders: BTreeMap<PathBuf, Vec<Replicate>> = BTreeMap::new();
    for (below, file) in files {
        if is_replicate(below) {
            let folder = below
                .parent()
                .expect("a replicate lies in a folder")
                .to_owned();
            folders
                .entry(folder)
                .or_default()
                .push(Replicate::read(file)?);
        }
    }
    (folders.into_iter())
        .map(|(folder, replicates)| {
            check(&folder, &replicates)?;
            Ok((folder, (Truth::of(&replicates)?, replicates.len())))
        })
        .collect()
}

/// Refuses replicates that leave a gap, are odd in number or have strayed into another folder.
fn check(folder: &Path, replicates: &[Replicate]) -> Result<(), Error> {
    let last = replicates
        .iter()
        .map(|replicate| replicate.index)
        .max()
        .unwrap_or(0);
    let count = (last + 1).next_multiple_of(2);
    let missing: Vec<u32> = (0..count)
        .filter(|index| replicates.iter().all(|replicate| replicate.index != *index))
        .collect();
    if let [first, ..] = missing.as_slice() {
        let words: Vec<String> = missing.iter().map(u32::to_string).collect();
        return Err(Error::Usage(format!(
            "{}: replicates {} are missing for a truth of {count}; render them with the options of the other parts and \
             --replicates {first}..{}",
            folder.display(),
            words.join(", "),
            first + 1
        )));
    }
    let one = &replicates[0];
    let home = replicates_folder(Path::new(&one.provenance.scene), one.alignment);
    if folder != home {
        return Err(Error::Usage(format!(
            "{} holds replicates that belong into {}; leave folders as `render` made them",
            folder.display(),
            home.display()
        )));
    }
    Ok(())
}

/// `<scene>/frame.exr` or `<scene>/truth_<alignment>/replicate_<index>.exr`.
fn is_rendered(path: &Path) -> bool {
    path.ends_with("frame.exr") || is_replicate(path)
}

fn is_replicate(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.starts_with("replicate_") && name.ends_with(".exr")
}

fn files_below(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let fail = |source| FileError::io(folder, "read", source);
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(fail)? {
        let path = entry.map_err(fail)?.path();
        if path.is_dir() {
            files.extend(files_below(&path)?);
        } else {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

fn read(path: &Path) -> Result<Vec<u8>, Error> {
    Ok(fs::read(path).map_err(|source| FileError::io(path, "read", source))?)
}
