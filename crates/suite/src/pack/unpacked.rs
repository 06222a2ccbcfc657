//! Files of a pack that a run copies into its folder.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use frame::{Alignment, FileError};
use store::{Pack, Wanted, refuse_scene, scene_folder, take};
use tracer::Scene;

use crate::Error;
use crate::measure::plan::RunPlan;
use crate::verify::scene::{Verified, verify_scene};
use crate::verify::scene_renders::list_scene_renders;
use crate::verify::tiles::Verification;

/// Folder inside a run's for files of a pack until they are verified.
const UNPACKED: &str = ".shuttertruth.unpacked";

/// What a run took from a pack.
#[derive(Clone, Debug, Default)]
pub struct Unpacked {
    /// Number of files that were taken.
    pub files: usize,
    /// Verification of these files.
    pub verified: Verified,
    /// What must still be rendered: `frame of fan`, `trailing truth of fan`.
    pub missing: Vec<String>,
}

/// Checks all of a pack, and copies from it what the plan needs and the plan's folder lacks, after tracing random tiles again. Truths of
/// other scenes, settings or tracers stay in the pack.
///
/// # Errors
/// The pack does not match its manifest, a tile differs, or a file cannot be written. Nothing is copied then.
pub fn take_pack(
    plan: &RunPlan,
    pack: &Pack,
    verification: &Verification,
) -> Result<Unpacked, Error> {
    pack.check()?;
    let alignments = plan.alignments();
    let wanted = find_wanted(plan, pack, &alignments)?;
    let mut taken = Unpacked::default();
    if !wanted.is_empty() {
        let unpacked = plan.out.join(UNPACKED);
        // A killed process may have left some.
        remove_folder(&unpacked)?;
        let found = take_verified(plan, pack, &wanted, verification);
        remove_folder(&unpacked)?;
        (taken.files, taken.verified) = found?;
    }
    for scene in list_scenes(plan) {
        let rendering = plan.rendering(&scene);
        let missing = rendering.find_missing(&alignments, plan.ladders, &[&plan.out]);
        let names = missing.into_iter().map(|file| match file.alignment() {
            None => format!("frame of {}", scene.id),
            Some(alignment) => format!("{alignment} truth of {}", scene.id),
        });
        taken.missing.extend(names);
    }
    Ok(taken)
}

/// Unpacks files into the folder of unpacked files, verifies them, and places those that the plan's folder lacks; counts the latter.
fn take_verified(
    plan: &RunPlan,
    pack: &Pack,
    wanted: &[(Scene, Vec<Wanted>)],
    verification: &Verification,
) -> Result<(usize, Verified), Error> {
    let unpacked = plan.out.join(UNPACKED);
    let files = || wanted.iter().flat_map(|(_, files)| files);
    let names: BTreeSet<String> = files().map(|file| file.path.to_string()).collect();
    pack.unpack(&unpacked, |file| names.contains(&file.path))?;
    let mut verified = Verified::default();
    for (scene, own) in wanted {
        verified.add(verify_unpacked(plan, pack, scene, own, verification)?);
    }
    if !verified.differences.is_empty() {
        return Err(Error::Usage(verified.differences.join("\n")));
    }
    Ok((take(files(), &unpacked, &plan.out)?, verified))
}

/// Lists the scenes of the plan with files that the pack has and the plan's folder lacks, and these files.
fn find_wanted(
    plan: &RunPlan,
    pack: &Pack,
    alignments: &[Alignment],
) -> Result<Vec<(Scene, Vec<Wanted>)>, Error> {
    let packed: BTreeMap<&str, &str> = (pack.manifest.files.iter())
        .map(|file| (file.path.as_str(), file.content_hash.as_str()))
        .collect();
    let mut wanted = Vec::new();
    for scene in list_scenes(plan) {
        refuse_scene(&scene_folder(&plan.out, &scene))?;
        let mut files = (plan.rendering(&scene)).list_wanted(alignments, plan.ladders);
        files.retain(|file| packed.get(&*file.path.to_string()) == Some(&&*file.hash));
        if files.iter().any(|file| !file.is_in(&plan.out)) {
            wanted.push((scene, files));
        }
    }
    Ok(wanted)
}

/// Verifies the files of a scene before they are used.
fn verify_unpacked(
    plan: &RunPlan,
    pack: &Pack,
    scene: &Scene,
    files: &[Wanted],
    verification: &Verification,
) -> Result<Verified, Error> {
    let unpacked = plan.out.join(UNPACKED);
    // The manifest may name another hash than the file has.
    if let Some(file) = files.iter().find(|file| !file.is_in(&unpacked)) {
        return Err(Error::Usage(format!(
            "{}: the header of {} has another content_hash than manifest.json says; the pack was altered: make or fetch it again",
            pack.path.display(),
            file.path
        )));
    }
    let folder = scene_folder(&unpacked, scene);
    let mut renders = list_scene_renders(&unpacked, &pack.path)?.into_iter();
    // All that was unpacked is verified, with or without a truth: a run makes truths from replicates.
    let own = renders.find(|own| own.folder == folder);
    let own = own.expect("a file of it was unpacked");
    verify_scene(scene, &own, verification, plan.monitor)
}

/// Lists the scenes of a plan and, after each, its later frames.
fn list_scenes(plan: &RunPlan) -> Vec<Scene> {
    let frames = 0..plan.frames.count;
    (plan.scenes.iter())
        .flat_map(|scene| frames.clone().map(|frame| scene.at_frame(frame)))
        .collect()
}

/// Removes the folder of unpacked files; a link in its place is removed, not followed.
fn remove_folder(folder: &Path) -> Result<(), Error> {
    let removed = match std::fs::symlink_metadata(folder) {
        Err(_) => Ok(()),
        Ok(found) if found.is_dir() => std::fs::remove_dir_all(folder),
        Ok(_) => std::fs::remove_file(folder),
    };
    Ok(removed.map_err(|source| FileError::io(folder, "remove", source))?)
}
