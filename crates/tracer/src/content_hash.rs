//! What goes into a file about its making, and into a cache's key.

use std::fmt::Debug;

use frame::Provenance;

use crate::scene::Scene;
use crate::settings::{FrameSettings, TruthSettings};
use crate::stage::Stage;

const PROGRAM: &str = concat!("shuttertruth ", env!("CARGO_PKG_VERSION"));

/// The content hash of the frame that [`trace_frame`](crate::trace_frame) would make, without making it: of the
/// scene's own hash, the settings and the tracer's sources. Equal hashes mean equal pixels.
pub fn frame_hash(scene: &Scene, settings: &FrameSettings) -> String {
    content_hash(scene, "frame", settings)
}

/// The content hash of every replicate of a truth, whatever their number; see [`frame_hash`].
pub fn replicate_hash(scene: &Scene, settings: &TruthSettings) -> String {
    let each = TruthSettings {
        samples_per_pixel: settings.samples_per_replicate(),
        replicates: 1,
        ..*settings
    };
    content_hash(scene, "replicate", &(each, &scene.shutter_profile))
}

/// The content hash of the truth that [`trace_truth`](crate::trace_truth) would make; see [`frame_hash`].
pub fn truth_hash(scene: &Scene, settings: &TruthSettings) -> String {
    frame::truth_hash(&replicate_hash(scene, settings), settings.replicates)
}

/// The content hash of the ladder that [`trace_ladder`](crate::trace_ladder) would make from the truth of the same
/// settings; see [`frame_hash`].
pub fn ladder_hash(scene: &Scene, settings: &TruthSettings, subframes: &[u32]) -> String {
    content_hash(
        scene,
        "ladder",
        &(settings, subframes, &scene.shutter_profile),
    )
}

pub(crate) fn provenance(
    stage: &Stage,
    seed: u64,
    samples_per_pixel: u32,
    replicates: u32,
    content_hash: String,
) -> Provenance {
    Provenance {
        scene: stage.scene.name.clone(),
        program: PROGRAM.into(),
        seed,
        samples_per_pixel,
        replicates,
        traversal: stage.traversal().into(),
        content_hash,
    }
}

/// Object names by id.
pub(crate) fn object_names(scene: &Scene) -> Vec<String> {
    std::iter::once("background".to_owned())
        .chain(scene.objects.iter().map(|object| object.name.clone()))
        .collect()
}

/// Debug output holds every field, and numbers so that they read back equal: a new setting cannot be forgotten.
fn content_hash(scene: &Scene, kind: &str, settings: &dyn Debug) -> String {
    let tracer = env!("TRACER_SOURCES");
    let text = format!("{PROGRAM}\n{tracer}\n{kind}\n{}\n{settings:?}", scene.hash);
    blake3::hash(text.as_bytes()).to_hex().to_string()
}
