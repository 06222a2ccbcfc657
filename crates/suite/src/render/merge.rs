//! Merge of replicates that several machines rendered.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use frame::{Replicate, Truth};
use store::{
    Files, MAX_REPLICATES, RenderFile, RenderPath, Sharing, claim, gather, list_renders,
    place_files,
};

use crate::Error;

/// A truth that was merged.
#[derive(Clone, Debug, PartialEq)]
pub struct Merged {
    /// The truth's file.
    pub truth: PathBuf,
    /// Number of its replicates.
    pub replicates: usize,
}

/// Takes frames and replicates of all `parts` into `out` and makes their truths. The same file may stand in several
/// parts if its bytes are equal. Nothing is written unless every truth is whole.
pub fn merge(parts: &[PathBuf], out: &Path) -> Result<Vec<Merged>, Error> {
    let files = gather_renders(parts)?;
    let truths = replicates_by_truth(&files);
    // One truth at a time is in memory, at first to see that all are whole.
    for (truth, files) in &truths {
        merge_replicates(truth, files)?;
    }
    let _claim = claim(out, [], Sharing::Together)?;
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
            return Err(Error::Usage(format!(
                "{} is named twice; allowed: each part once",
                part.display()
            )));
        }
        let mut own = list_renders(part)?;
        own.retain(|render| matches!(render.file, RenderFile::Frame | RenderFile::Replicate(..)));
        if own.is_empty() {
            return Err(Error::Usage(format!(
                "{} holds no replicates; allowed: folders into which `shuttertruth truths render` wrote a part A..B of the replicates, or \
                 finished runs alone",
                part.display()
            )));
        }
        lists.push((&**part, own.iter().map(RenderPath::path).collect()));
    }
    Ok(gather(lists)?)
}

/// Groups replicates by their truths.
fn replicates_by_truth(files: &Files) -> BTreeMap<RenderPath, Vec<&Path>> {
    let mut truths: BTreeMap<RenderPath, Vec<&Path>> = BTreeMap::new();
    for (below, file) in files {
        if let Some(render) = RenderPath::parse(below)
            && let RenderFile::Replicate(alignment, _) = render.file
        {
            let truth = RenderPath {
                file: RenderFile::Truth(alignment),
                ..render
            };
            truths.entry(truth).or_default().push(file);
        }
    }
    truths
}

/// Makes a truth of its replicates.
fn merge_replicates(truth: &RenderPath, files: &[&Path]) -> Result<Truth, Error> {
    let folder = truth.path().with_extension("");
    let mut replicates = Vec::new();
    for file in files {
        let replicate = Replicate::read(file)?;
        if replicate.index >= MAX_REPLICATES {
            return Err(Error::Usage(format!(
                "{} is replicate {}; allowed: 0 to {}",
                file.display(),
                replicate.index,
                MAX_REPLICATES - 1
            )));
        }
        replicates.push(replicate);
    }
    // By name, replicate_1000 stands before replicate_999.
    replicates.sort_by_key(|replicate| replicate.index);
    check_replicates(truth, &replicates)?;
    Truth::of(&replicates).map_err(|error| Error::Usage(format!("{}: {error}", folder.display())))
}

/// Refuses replicates that leave a gap, are odd in number or belong into another folder.
fn check_replicates(truth: &RenderPath, replicates: &[Replicate]) -> Result<(), Error> {
    let folder = truth.path().with_extension("");
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
    let home = RenderPath {
        scene: one.provenance.scene.parse().map_err(Error::Usage)?,
        file: RenderFile::Truth(one.alignment),
    };
    if *truth != home {
        return Err(Error::Usage(format!(
            "{} holds replicates that belong into {}; leave folders as `shuttertruth truths render` made them",
            folder.display(),
            home.path().with_extension("").display()
        )));
    }
    Ok(())
}
