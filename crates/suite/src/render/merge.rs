//! Merge of replicates that several machines rendered.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use frame::{Alignment, FileError, Replicate, Truth, read_bounded, write_atomically};

use crate::Error;
use crate::folder::claim::{Sharing, claim};
use crate::render::replicates::replicates_folder;
use crate::render::settings::MOST_REPLICATES;

/// Upper limit on the bytes of a frame or a replicate that is merged with others.
pub const MOST_PART_BYTES: u64 = 1 << 32;

/// A truth that was merged.
#[derive(Clone, Debug, PartialEq)]
pub struct Merged {
    /// The truth's file.
    pub truth: PathBuf,
    /// Number of its replicates.
    pub replicates: usize,
}

/// The source of each file, by its path below the parts.
type Files = BTreeMap<PathBuf, PathBuf>;

/// Copies frames and replicates of all `parts` into `out` and makes their truths. The same file may stand in several
/// parts if its bytes are equal. Nothing is written unless every truth is whole.
pub fn merge(parts: &[PathBuf], out: &Path) -> Result<Vec<Merged>, Error> {
    let files = gather(parts)?;
    let folders = replicates_by_folder(&files);
    // One truth at a time is in memory, at first to see that all are whole.
    for (folder, files) in &folders {
        merge_replicates(folder, files)?;
    }
    let _claim = claim(out, [], Sharing::Together)?;
    for (below, file) in &files {
        write_atomically(&out.join(below), &read(file)?)?;
    }
    (folders.iter())
        .map(|(folder, files)| {
            let path = out.join(folder).with_extension("exr");
            merge_replicates(folder, files)?.write(&path)?;
            Ok(Merged {
                truth: path,
                replicates: files.len(),
            })
        })
        .collect()
}

/// Lists every frame and replicate of all parts.
fn gather(parts: &[PathBuf]) -> Result<Files, Error> {
    let mut files = Files::new();
    for (index, part) in parts.iter().enumerate() {
        if parts[..index].contains(part) {
            return Err(Error::Usage(format!(
                "{} is named twice; allowed: each part once",
                part.display()
            )));
        }
        let own = rendered_below(part)?;
        if own.is_empty() {
            return Err(Error::Usage(format!(
                "{} holds no replicates; allowed: folders into which `shuttertruth truths render` wrote a part A..B of the replicates, or \
                 finished runs alone",
                part.display()
            )));
        }
        for below in own {
            let file = part.join(&below);
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
    }
    Ok(files)
}

/// Groups replicates by their folders.
fn replicates_by_folder(files: &Files) -> BTreeMap<PathBuf, Vec<&Path>> {
    let mut folders: BTreeMap<PathBuf, Vec<&Path>> = BTreeMap::new();
    for (below, file) in files {
        if let Some(folder) = below.parent().filter(|_| is_replicate(below)) {
            folders.entry(folder.to_owned()).or_default().push(file);
        }
    }
    folders
}

/// Makes the truth of a folder's replicates.
fn merge_replicates(folder: &Path, files: &[&Path]) -> Result<Truth, Error> {
    let mut replicates = Vec::new();
    for file in files {
        let replicate = Replicate::read(file)?;
        if replicate.index >= MOST_REPLICATES {
            return Err(Error::Usage(format!(
                "{} is replicate {}; allowed: 0 to {}",
                file.display(),
                replicate.index,
                MOST_REPLICATES - 1
            )));
        }
        replicates.push(replicate);
    }
    // By name, replicate_1000 stands before replicate_999.
    replicates.sort_by_key(|replicate| replicate.index);
    check_replicates(folder, &replicates)?;
    Truth::of(&replicates).map_err(|error| Error::Usage(format!("{}: {error}", folder.display())))
}

/// Refuses replicates that leave a gap, are odd in number or belong into another folder.
fn check_replicates(folder: &Path, replicates: &[Replicate]) -> Result<(), Error> {
    if let Some(pair) = (replicates.windows(2)).find(|pair| pair[0].index == pair[1].index) {
        return Err(Error::Usage(format!(
            "{}: two files hold replicate {}; leave names as `shuttertruth truths render` made them",
            folder.display(),
            pair[0].index
        )));
    }
    let last = replicates.last().map_or(0, |replicate| replicate.index);
    let count = (last + 1).next_multiple_of(2);
    let missing: Vec<u32> = (0..count)
        .filter(|index| {
            let found = replicates.binary_search_by_key(index, |replicate| replicate.index);
            found.is_err()
        })
        .collect();
    if let [first, ..] = missing.as_slice() {
        let words: Vec<String> = missing.iter().map(u32::to_string).collect();
        return Err(Error::Usage(format!(
            "{}: replicates {} are missing for a truth of {count}; render them with the settings of the other parts, as \
             replicates {first}..{}",
            folder.display(),
            words.join(", "),
            first + 1
        )));
    }
    let one = &replicates[0];
    let home = replicates_folder(Path::new(&one.provenance.scene), one.alignment);
    if folder != home {
        return Err(Error::Usage(format!(
            "{} holds replicates that belong into {}; leave folders as `shuttertruth truths render` made them",
            folder.display(),
            home.display()
        )));
    }
    Ok(())
}

/// Lists frames and replicates of a part, by their paths below it: `<scene>/frame.exr` and
/// `<scene>/truth_<alignment>/replicate_<index>.exr`, and the same of later frames in `<scene>/0001` and so on. Looks nowhere else,
/// and so follows no loop of links.
fn rendered_below(part: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut found = Vec::new();
    let mut scenes = Vec::new();
    for scene in entries(part)?.into_iter().map(PathBuf::from) {
        if !part.join(&scene).is_dir() {
            continue;
        }
        let names = entries(&part.join(&scene))?.into_iter();
        let is_frame = |name: &std::ffi::OsString| {
            (name.to_str()).is_some_and(|name| name.bytes().all(|byte| byte.is_ascii_digit()))
        };
        let frames = names.filter(is_frame).map(|name| scene.join(name));
        scenes.extend(frames.filter(|frame| part.join(frame).is_dir()));
        scenes.push(scene);
    }
    for scene in scenes {
        let frame = scene.join("frame.exr");
        if part.join(&frame).exists() {
            found.push(frame);
        }
        for alignment in Alignment::ALL {
            let folder = replicates_folder(&scene, alignment);
            if !part.join(&folder).is_dir() {
                continue;
            }
            let files = entries(&part.join(&folder))?.into_iter();
            found.extend(
                files
                    .map(|name| folder.join(name))
                    .filter(|file| is_replicate(file)),
            );
        }
    }
    found.sort();
    Ok(found)
}

fn is_replicate(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.starts_with("replicate_") && name.ends_with(".exr")
}

/// Lists the names in a folder.
fn entries(folder: &Path) -> Result<Vec<std::ffi::OsString>, Error> {
    let fail = |source| FileError::io(folder, "read", source);
    (fs::read_dir(folder).map_err(fail)?)
        .map(|entry| Ok(entry.map_err(fail)?.file_name()))
        .collect()
}

fn read(path: &Path) -> Result<Vec<u8>, Error> {
    Ok(read_bounded(path, MOST_PART_BYTES)?)
}
