//! Frames, truths and ladders that lie in a folder, and are taken from there instead of rendered.

use std::path::Path;

use frame::Alignment;
use store::{RenderFile, RenderPath, Wanted};
use tracer::{RenderSettings, Scene};

use super::ladders::{ladder_hash, needed_rungs};
use super::settings::frame_settings;

/// Lists the frame of a scene, and its truths with their replicates, and with the rungs of their ladders that measuring needs: all
/// if ladders are asked for.
pub(crate) fn list_render_files(
    scene: &Scene,
    settings: &RenderSettings,
    alignments: &[Alignment],
    ladders: bool,
) -> Vec<Wanted> {
    let wanted = |file, hash: &str| Wanted {
        path: RenderPath {
            scene: scene.id.clone(),
            file,
        },
        hash: hash.to_owned(),
    };
    let frame = tracer::frame_hash(scene, &frame_settings(settings));
    let mut files = vec![wanted(RenderFile::Frame, &frame)];
    for &alignment in alignments {
        let truth = tracer::truth_hash(scene, settings, alignment);
        files.push(wanted(RenderFile::Truth(alignment), &truth));
        let replicate = tracer::replicate_hash(scene, settings, alignment);
        let replicates = 0..settings.replicates;
        files.extend(
            replicates.map(|index| wanted(RenderFile::Replicate(alignment, index), &replicate)),
        );
        let ladder = ladder_hash(scene, settings, alignment);
        let rungs = needed_rungs(alignment, ladders).iter();
        files.extend(rungs.map(|rung| wanted(RenderFile::Rung(alignment, *rung), &ladder)));
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
    let has = |file: &Wanted| file.is_in(truths);
    let of_truth = |alignment: &Alignment| {
        let files = list_render_files(scene, render, &[*alignment], ladders);
        // The frame, the truth, its replicates, and the rungs.
        has(&files[1]) && files.last().is_some_and(has)
    };
    let frame = has(&list_render_files(scene, render, &[], ladders)[0]);
    (frame, alignments.iter().map(of_truth).collect())
}
