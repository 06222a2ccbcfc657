//! Files of a run's folder in a pack: all that a run renders and reads, and nothing that filters made.

use std::collections::BTreeMap;
use std::path::Path;

use frame::{Alignment, ExrFile, read_exr_header, truth_hash};
use store::{PackedFile, RenderFile, RenderPath};
use tracer::SceneId;

use crate::Error;
use crate::render::files::{remove_truth, truth_files};
use crate::run::Run;
use crate::run::case::{ACCUMULATE, Case};

/// What the cases of a run say about a truth.
#[derive(Default)]
struct CasesOfTruth<'a> {
    /// `truth_hash` of the cases' truth; none without cases.
    hash: Option<&'a str>,
    /// True if the run compares with accumulations of several sub-frames: the whole ladder was rendered.
    has_ladder: bool,
}

/// The truths of each scene, by alignment.
type Truths<'a> = BTreeMap<&'a SceneId, BTreeMap<Alignment, CasesOfTruth<'a>>>;

/// Lists a finished run's frames, truths, replicates and ladders by path. A check's ladders have only the sharp rungs. Sizes and byte
/// hashes are not known yet.
pub(super) fn list_contents(
    run: &Run,
    folder: &Path,
    scenes: &[String],
) -> Result<Vec<PackedFile>, Error> {
    let mut files = Vec::new();
    for (scene, truths) in list_truths(run, scenes)? {
        for frame in 0..run.frames.count {
            let path = |file| RenderPath {
                scene: scene.at_frame(frame),
                file,
            };
            files.push(read_header(folder, &path(RenderFile::Frame))?);
            for (&alignment, cases) in &truths {
                let own = truth_files(alignment, run.render.replicates, cases.has_ladder)
                    .map(|file| Ok((file, read_header(folder, &path(file))?)))
                    .collect::<Result<Vec<_>, Error>>()?;
                // run.json has no cases of later frames.
                let measured = cases.hash.filter(|_| frame == 0);
                check_truth(run, folder, &own, measured)?;
                files.extend(own.into_iter().map(|(_, file)| file));
            }
        }
    }
    files.sort_by(|one, other| one.path.cmp(&other.path));
    Ok(files)
}

/// Lists the truths of the chosen scenes; leaves out engines' scenes, which have their truths elsewhere.
fn list_truths<'a>(run: &'a Run, chosen: &[String]) -> Result<Truths<'a>, Error> {
    let mut truths = Truths::new();
    let is_chosen = |case: &&Case| case.drawn.is_none() && chosen.contains(&case.scene.to_string());
    for case in run.cases.iter().filter(is_chosen) {
        let common = (run.common_alignment, CasesOfTruth::default());
        let own = (truths.entry(&case.scene)).or_insert_with(|| BTreeMap::from([common]));
        let own = own.entry(case.alignment).or_default();
        own.has_ladder |= case.is_reference && case.filter == ACCUMULATE && !case.is_sharp();
        let other = own.hash.replace(&case.truth_hash);
        if other.is_some_and(|other| other != case.truth_hash) {
            return Err(Error::Usage(format!(
                "{}: cases were measured against different {} truths, and the folder has only the last; run it again",
                case.scene, case.alignment
            )));
        }
    }
    match truths.is_empty() {
        false => Ok(truths),
        true => Err(Error::Usage(
            "an engine drew all of these scenes: nothing was rendered that a pack could hold; pack a run of scenes of ours"
                .to_owned(),
        )),
    }
}

/// Refuses a truth that the cases were not measured against, replicates of another truth, and rungs of several ladders.
fn check_truth(
    run: &Run,
    root: &Path,
    files: &[(RenderFile, PackedFile)],
    measured: Option<&str>,
) -> Result<(), Error> {
    let truth = &files[0].1.content_hash;
    let ladder = &files[files.len() - 1].1.content_hash;
    for (
        file,
        PackedFile {
            path, content_hash, ..
        },
    ) in files
    {
        let (found, expected) = match file {
            RenderFile::Replicate(..) => (
                truth_hash(content_hash, run.render.replicates),
                truth.as_str(),
            ),
            RenderFile::Rung(..) => (content_hash.clone(), ladder.as_str()),
            RenderFile::Frame | RenderFile::Truth(_) => {
                (content_hash.clone(), measured.unwrap_or(content_hash))
            }
        };
        if found != expected {
            let path = root.join(path);
            let folder = match (file, path.parent()) {
                (RenderFile::Replicate(..), Some(folder)) => remove_truth(folder),
                _ => String::new(),
            };
            return Err(Error::Usage(format!(
                "{}: its header has the hash {content_hash}, and the run was measured with {expected}; something was rendered into this \
                 folder since: {folder}run it again",
                path.display()
            )));
        }
    }
    Ok(())
}

/// Describes a rendered file from its header.
fn read_header(root: &Path, file: &RenderPath) -> Result<PackedFile, Error> {
    let path = root.join(file.path());
    if !path.symlink_metadata().is_ok_and(|found| found.is_file()) {
        let folder = match (file.file, path.parent()) {
            (RenderFile::Replicate(..), Some(folder)) => remove_truth(folder),
            _ => String::new(),
        };
        return Err(Error::Usage(format!(
            "{}: there is no such file, or it is no regular one; the run is unfinished, or its files were moved; {folder}run it again \
             into this folder, or render the missing truths with their ladders",
            path.display()
        )));
    }
    let describe = |found: ExrFile| {
        Some(PackedFile {
            path: file.to_string(),
            bytes: 0,
            blake3: String::new(),
            content_hash: found.get("content_hash").ok()?,
            scene: found.get("scene").ok()?,
            width: found.width,
            height: found.height,
            samples_per_pixel: found.get("samples_per_pixel").ok()?,
        })
    };
    read_exr_header(&path).and_then(describe).ok_or_else(|| {
        Error::Usage(format!(
            "{}: not a complete file of this program; delete it and run again into this folder",
            path.display()
        ))
    })
}
