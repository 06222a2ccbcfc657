//! The files of a run's folder that a pack holds: all that a run renders and reads, and none that filters made.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use frame::{Alignment, ExrFile, read_exr_header, truth_hash};
use store::{PackedFile, RenderFile, RenderPath};
use tracer::SceneId;

use crate::Error;
use crate::render::ladders::needed_rungs;
use crate::run::Run;
use crate::run::case::ACCUMULATE;

/// The truths of one scene, or of a later frame of it.
struct KeptScene {
    scene: SceneId,
    /// Alignments of its truths, each with the `truth_hash` of the cases that were measured against it; none where no case was.
    truths: BTreeMap<Alignment, Option<String>>,
    /// Alignments that the run has accumulations of several sub-frames of: those whose whole ladder was rendered.
    ladders: BTreeSet<Alignment>,
}

/// Lists frames, truths, replicates and ladders of a finished run, in the order of their paths. A check has the sharp rungs of ladders
/// alone. Sizes and hashes of bytes are not known yet.
///
/// # Errors
/// A file is missing, or is another one than the run was measured with.
pub(super) fn list_contents(
    run: &Run,
    folder: &Path,
    scenes: &[String],
) -> Result<Vec<PackedFile>, Error> {
    let mut files = Vec::new();
    for scene in list_scenes(run, scenes)? {
        add_scene(run, folder, &scene, &mut files)?;
    }
    files.sort_by(|one, other| one.path.cmp(&other.path));
    Ok(files)
}

/// Lists the chosen scenes and their later frames; leaves out those that engines drew, which have their truths elsewhere.
fn list_scenes(run: &Run, chosen: &[String]) -> Result<Vec<KeptScene>, Error> {
    let mut truths: BTreeMap<&SceneId, BTreeMap<Alignment, Option<String>>> = BTreeMap::new();
    for case in run.cases.iter().filter(|case| case.drawn.is_none()) {
        let alignment = case.alignment;
        let own = truths.entry(&case.scene).or_default();
        let hash = Some(case.truth_hash.clone());
        match own.insert(alignment, hash.clone()) {
            Some(other) if other != hash => {
                return Err(Error::Usage(format!(
                    "{}: cases were measured against different {alignment} truths, of which only the last is kept; run it again",
                    case.scene
                )));
            }
            _ => {}
        }
    }
    let mut scenes = Vec::new();
    let is_chosen = |scene: &SceneId| chosen.contains(&scene.to_string());
    for (scene, own) in (truths.iter()).filter(|(scene, _)| is_chosen(scene)) {
        let alignments: BTreeSet<Alignment> =
            own.keys().copied().chain([run.common_alignment]).collect();
        let ladders: BTreeSet<Alignment> = (alignments.iter().copied())
            .filter(|alignment| has_accumulation(run, scene, *alignment))
            .collect();
        for frame in 0..run.frames.count {
            let hash = |alignment| own.get(&alignment).cloned().flatten();
            scenes.push(KeptScene {
                scene: scene.at_frame(frame),
                // Cases of later frames are not in run.json.
                truths: (alignments.iter())
                    .map(|&alignment| (alignment, hash(alignment).filter(|_| frame == 0)))
                    .collect(),
                ladders: ladders.clone(),
            });
        }
    }
    match scenes.is_empty() {
        false => Ok(scenes),
        true => Err(Error::Usage(
            "an engine drew all of these scenes: nothing was rendered that a pack could hold; pack a run of scenes of ours"
                .to_owned(),
        )),
    }
}

/// Tells whether a run compares with accumulations of several sub-frames in a scene, for one alignment.
fn has_accumulation(run: &Run, scene: &SceneId, alignment: Alignment) -> bool {
    (run.cases.iter()).any(|case| {
        case.is_reference
            && case.filter == ACCUMULATE
            && !case.is_sharp()
            && case.scene == *scene
            && case.alignment == alignment
    })
}

/// Adds the files of one scene.
fn add_scene(
    run: &Run,
    root: &Path,
    scene: &KeptScene,
    files: &mut Vec<PackedFile>,
) -> Result<(), Error> {
    let found = |file| {
        let scene = scene.scene.clone();
        read_kept(root, &RenderPath { scene, file })
    };
    files.push(found(RenderFile::Frame)?);
    for (&alignment, hash) in &scene.truths {
        let truth = found(RenderFile::Truth(alignment))?;
        if let Some(hash) = hash.as_ref().filter(|hash| **hash != truth.content_hash) {
            return Err(other_file(root, &truth, hash));
        }
        let count = run.render.replicates;
        for index in 0..count {
            let replicate = found(RenderFile::Replicate(alignment, index))?;
            if truth_hash(&replicate.content_hash, count) != truth.content_hash {
                return Err(other_file(root, &replicate, &truth.content_hash));
            }
            files.push(replicate);
        }
        files.push(truth);
        let mut ladder: Option<String> = None;
        for rung in needed_rungs(alignment, scene.ladders.contains(&alignment)) {
            let rung = found(RenderFile::Rung(alignment, *rung))?;
            let hash = ladder.get_or_insert_with(|| rung.content_hash.clone());
            if *hash != rung.content_hash {
                return Err(other_file(root, &rung, hash));
            }
            files.push(rung);
        }
    }
    Ok(())
}

/// Reads the header of a kept file.
fn read_kept(root: &Path, file: &RenderPath) -> Result<PackedFile, Error> {
    let path = root.join(file.path());
    if !path.symlink_metadata().is_ok_and(|found| found.is_file()) {
        return Err(Error::Usage(format!(
            "{}: there is no such file, or it is no regular one; the run is unfinished, or its files were moved; run it again into \
             this folder, or render the missing truths with their ladders",
            path.display()
        )));
    }
    let found = read_exr_header(&path).and_then(|found| describe(&found, file));
    found.ok_or_else(|| {
        Error::Usage(format!(
            "{}: not a complete file of this program; delete it and run again into this folder",
            path.display()
        ))
    })
}

/// Describes a file by its header; none where that lacks what the files of this program have.
fn describe(file: &ExrFile, path: &RenderPath) -> Option<PackedFile> {
    Some(PackedFile {
        path: path.to_string(),
        bytes: 0,
        blake3: String::new(),
        content_hash: file.get("content_hash").ok()?,
        scene: file.get("scene").ok()?,
        width: file.width,
        height: file.height,
        samples_per_pixel: file.get("samples_per_pixel").ok()?,
    })
}

fn other_file(root: &Path, file: &PackedFile, expected: &str) -> Error {
    Error::Usage(format!(
        "{}: its header has the hash {}, and the run was measured with {expected}; something was rendered into this folder since: run \
         it again",
        root.join(&file.path).display(),
        file.content_hash
    ))
}
