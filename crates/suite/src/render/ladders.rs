//! Ladders of sub-frame accumulations.

use std::path::Path;

use frame::{Alignment, Ladder, Truth};
use tracer::{Scene, TruthSettings};

use super::cached_file::CachedFile;
use super::settings::RenderSettings;
use super::truths::render_truth;
use crate::folder::scene_folder::scene_folder;
use crate::{Error, Monitor};

/// Sub-frame counts of the ladder that N_eq is read from.
pub const LADDER: [u32; 7] = [1, 2, 4, 8, 16, 32, 64];

/// Renders a truth and its ladder of accumulations; reads from `out` what lies there with the same inputs.
pub fn render_truth_and_ladder(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
    out: &Path,
    monitor: Monitor,
) -> Result<(Truth, Ladder), Error> {
    let truth = render_truth(scene, settings, alignment, out, monitor)?;
    let settings = settings.for_truth(scene, alignment);
    let file = CachedFile {
        path: scene_folder(out, scene).join(format!("ladder_{alignment}.exr")),
        label: format!("{} sub-frames, {alignment}", scene.name),
        hash: ladder_hash(scene, &settings),
    };
    let ladder = file.read_or_render(
        monitor,
        |watch| {
            let ladder = tracer::trace_ladder(scene, &settings, &truth, &LADDER, watch);
            Ok(ladder?)
        },
        (Ladder::read, Ladder::write, |ladder| {
            &ladder.provenance.content_hash
        }),
    )?;
    Ok((truth, ladder))
}

/// Hashes the inputs of the ladder that goes with the truth of these settings.
pub(crate) fn ladder_hash(scene: &Scene, settings: &TruthSettings) -> String {
    tracer::ladder_hash(scene, settings, &LADDER)
}
