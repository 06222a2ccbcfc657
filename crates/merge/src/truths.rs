//! Merge of replicates that several machines rendered.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use frame::{Replicate, Truth, TruthError};
use measure::{Error, RenderFile, RenderPath, Sharing, list_renders, lock_folder};

use crate::gather::{Files, gather, place_files};

/// A merged truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Merged {
    /// The truth's file.
    pub truth: PathBuf,
    /// Number of its replicates.
    pub replicates: usize,
}

/// Copies frames and replicates of all `parts` into `out` and makes their truths. Several parts may
/// contain the same file if its bytes are equal. Nothing is written unless every truth is complete.
pub fn merge_truths(parts: &[PathBuf], out: &Path) -> Result<Vec<Merged>, Error> {
    let files = gather_renders(parts)?;
    let truths = replicates_by_truth(&files);
    // One truth at a time is in memory, first to check that all are complete.
    for (truth, files) in &truths {
        merge_replicates(truth, files)?;
    }
    let _lock = lock_folder(out, [], Sharing::Together)?;
    place_files(&files, out)?;
    (truths.iter())
        .map(|(truth, files)| {
            let path = out.join(truth.path());
            merge_replicates(truth, files)?.write(&path)?;
            Ok(Merged {
                truth: path,
                replicates: files.len(),
            })
        })
        .collect()
}

/// Gathers the frames and the replicates of all parts.
fn gather_renders(parts: &[PathBuf]) -> Result<Files, Error> {
    let mut lists = Vec::new();
    for (index, part) in parts.iter().enumerate() {
        if parts[..index].contains(part) {
            return Err(Error::Refused(format!(
                "{} is named twice; allowed: each part once",
                part.display()
            )));
        }
        let mut renders = list_renders(part)?;
        renders
            .retain(|render| matches!(render.file, RenderFile::Frame | RenderFile::Replicate(..)));
        if renders.is_empty() {
            return Err(Error::Refused(format!(
                "{} holds no replicates; allowed: folders into which `shuttertruth truths render` wrote a part A..B of the replicates, or \
                 finished runs alone",
                part.display()
            )));
        }
        lists.push((&**part, renders.iter().map(RenderPath::path).collect()));
    }
    gather(lists)
}

/// The files of each truth's replicates, by index.
type Replicates<'a> = BTreeMap<RenderPath, BTreeMap<u32, &'a Path>>;

/// Groups replicates by their truths.
fn replicates_by_truth(files: &Files) -> Replicates<'_> {
    let mut truths = Replicates::new();
    for (below, file) in files {
        if let Some(render) = RenderPath::parse(below)
            && let RenderFile::Replicate(alignment, index) = render.file
        {
            let truth = RenderPath {
                file: RenderFile::Truth(alignment),
                ..render
            };
            truths.entry(truth).or_default().insert(index, file);
        }
    }
    truths
}

/// Makes a truth from its replicates; refuses those that leave a gap, or are odd in number.
fn merge_replicates(truth: &RenderPath, files: &BTreeMap<u32, &Path>) -> Result<Truth, Error> {
    let folder = truth.path().with_extension("");
    let last = files.last_key_value().map_or(0, |(index, _)| *index);
    let count = (last + 1).next_multiple_of(2);
    let missing: Vec<u32> = (0..count)
        .filter(|index| !files.contains_key(index))
        .collect();
    if let [first, ..] = missing.as_slice() {
        let words: Vec<String> = missing.iter().map(u32::to_string).collect();
        return Err(Error::Refused(format!(
            "{}: replicates {} are missing for a truth of {count}; render them with the settings of the other parts, as \
             replicates {first}..{}",
            folder.display(),
            words.join(", "),
            first + 1
        )));
    }
    let replicates = (files.values()).map(|file| read_replicate(truth, file));
    Truth::of(&replicates.collect::<Result<Vec<_>, _>>()?).map_err(|error| {
        let way_out = match error {
            TruthError::Foreign { .. } => {
                "; render all with one --size, --samples-per-pixel and --seed, or remove those of the other render"
            }
            _ => "",
        };
        Error::Refused(format!("{}: {error}{way_out}", folder.display()))
    })
}

/// Reads a replicate, and refuses one that belongs elsewhere.
fn read_replicate(truth: &RenderPath, path: &Path) -> Result<Replicate, Error> {
    let replicate = Replicate::read(path)?;
    let file = RenderFile::Replicate(replicate.alignment, replicate.index).path();
    let belongs = truth.scene == replicate.provenance.scene.as_str()
        && truth.file.alignment() == Some(replicate.alignment)
        && path.file_name() == file.file_name();
    if belongs {
        Ok(replicate)
    } else {
        Err(Error::Refused(format!(
            "{} holds {}/{}; leave folders and names as `shuttertruth truths render` made them",
            path.display(),
            replicate.provenance.scene,
            file.display()
        )))
    }
}
