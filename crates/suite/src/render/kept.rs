//! Frames, truths and ladders that lie in another folder, and are taken from there instead of rendered.

use std::path::{Path, PathBuf};

use frame::{Alignment, read_attribute, rung_file};
use tracer::{RenderSettings, Scene};

use super::ladders::{ladder_folder, ladder_hash, needed_rungs};
use super::replicates::ReplicateFiles;
use super::settings::frame_settings;
use crate::Error;
use crate::folder::placed_file::place_file;
use crate::folder::scene_folder::{refuse_scene, scene_folder};

/// A file of a render, by its path below an output folder, and the content hash that its header must have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct RenderFile {
    /// `railing/truth_trailing.exr`.
    pub below: PathBuf,
    /// Hash of its inputs.
    pub hash: String,
}

/// Lists the frame of a scene, and its truths with their replicates, and with the rungs of their ladders that measuring needs: all
/// if ladders are asked for.
pub(crate) fn list_render_files(
    scene: &Scene,
    settings: &RenderSettings,
    alignments: &[Alignment],
    ladders: bool,
) -> Vec<RenderFile> {
    let folder = scene_folder(Path::new(""), scene);
    let mut files = vec![RenderFile {
        below: folder.join("frame.exr"),
        hash: tracer::frame_hash(scene, &frame_settings(settings)),
    }];
    for &alignment in alignments {
        let replicates = ReplicateFiles::new(folder.clone(), scene, settings, alignment);
        files.push(RenderFile {
            below: replicates.truth_path(),
            hash: tracer::truth_hash(scene, settings, alignment),
        });
        files.extend((0..settings.replicates).map(|index| RenderFile {
            below: replicates.path(index),
            hash: replicates.hash.clone(),
        }));
        let hash = ladder_hash(scene, settings, alignment);
        let rungs = needed_rungs(alignment, ladders).iter();
        files.extend(rungs.map(|rung| RenderFile {
            below: (folder.join(ladder_folder(alignment))).join(rung_file(*rung)),
            hash: hash.clone(),
        }));
    }
    files
}

/// Tells whether the folder `truths` has the frame of a scene, and each of its truths with its last replicate, or the last rung of its
/// ladder if `ladders` are asked for.
pub(crate) fn find_kept(
    scene: &Scene,
    render: &RenderSettings,
    alignments: &[Alignment],
    ladders: bool,
    truths: &Path,
) -> (bool, Vec<bool>) {
    let has = |file: &RenderFile| file.is_in(truths);
    let of_truth = |alignment: &Alignment| {
        let files = list_render_files(scene, render, &[*alignment], ladders);
        // The frame, the truth, its replicates, and the rungs.
        has(&files[1]) && files.last().is_some_and(has)
    };
    let frame = has(&list_render_files(scene, render, &[], ladders)[0]);
    (frame, alignments.iter().map(of_truth).collect())
}

impl RenderFile {
    /// Returns its path below a folder with `/` between its parts, as a pack names it.
    pub fn name(&self) -> String {
        let parts = self.below.iter().map(|part| part.to_string_lossy());
        parts.collect::<Vec<_>>().join("/")
    }

    /// Tells whether a folder holds it, by the header of the file.
    pub fn is_in(&self, folder: &Path) -> bool {
        read_attribute(&folder.join(&self.below), "content_hash").as_ref() == Some(&self.hash)
    }
}

/// Takes the files of a scene from the folder `truths` into `out`, unless they are there. What neither holds is left to be rendered.
/// Returns the number of files that were taken.
///
/// # Errors
/// Fails if a file cannot be taken.
pub(crate) fn take_renders(
    files: &[RenderFile],
    scene: &Scene,
    truths: &Path,
    out: &Path,
) -> Result<usize, Error> {
    refuse_scene(&scene_folder(out, scene))?;
    let mut taken = 0;
    for file in files {
        if !file.is_in(out) && file.is_in(truths) {
            place_file(&truths.join(&file.below), &out.join(&file.below))?;
            taken += 1;
        }
    }
    Ok(taken)
}
