//! The content hashes of renders, and their provenance.

use std::fmt::Debug;

use frame::{Alignment, FrameOptions, Provenance};
use scene::Scene;

use crate::pixel_grid::PixelGrid;
use crate::settings::RenderSettings;
use crate::stage::Stage;

const PROGRAM: &str = concat!("shuttertruth ", env!("CARGO_PKG_VERSION"));

/// The content hash of the frame with these settings and replicates, on its picture's own pixels.
/// It covers the scene's own hash, the settings and the tracer's sources, so equal hashes mean
/// equal pixels.
pub fn frame_hash(scene: &Scene, settings: &RenderSettings) -> String {
    let settings = RenderSettings {
        exposure: Some(settings.exposure(scene)),
        ..*settings
    };
    // Its samples are chosen for the time that its truths' shutters are open.
    content_hash(scene, "frame", &(settings, &scene.shutter_profile))
}

/// The content hash of the frame that [`trace_frame_part`](crate::trace_frame_part) would render;
/// on the picture's own pixels it equals [`frame_hash`].
pub(crate) fn grid_hash(scene: &Scene, settings: &RenderSettings, grid: &PixelGrid) -> String {
    let frame = frame_hash(scene, settings);
    if *grid == PixelGrid::of_picture(settings.width, settings.height) {
        return frame;
    }
    content_hash(scene, "grid", &(frame, grid))
}

/// The content hash that all replicates of a truth share, independent of their number; see
/// [`frame_hash`].
pub fn replicate_hash(scene: &Scene, settings: &RenderSettings, alignment: Alignment) -> String {
    let each = settings.with_replicates(1);
    content_hash(
        scene,
        "replicate",
        &list_truth_inputs(scene, &each, alignment),
    )
}

/// The content hash of the truth that [`trace_truth`](crate::trace_truth) would render; see
/// [`frame_hash`].
pub fn truth_hash(scene: &Scene, settings: &RenderSettings, alignment: Alignment) -> String {
    let each = replicate_hash(scene, settings, alignment);
    frame::truth_hash(&each, settings.replicates)
}

/// The content hash of the ladder that [`trace_ladder`](crate::trace_ladder) would render from the
/// truth of the same settings; see [`frame_hash`].
pub fn ladder_hash(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
    subframes: &[u32],
) -> String {
    let truth = list_truth_inputs(scene, settings, alignment);
    content_hash(scene, "ladder", &(truth, subframes))
}

/// Lists the inputs that change the pixels of a truth: settings of the frame do not.
fn list_truth_inputs(scene: &Scene, settings: &RenderSettings, alignment: Alignment) -> impl Debug {
    let settings = RenderSettings {
        options: FrameOptions::default(),
        guard_band: 0,
        exposure: Some(settings.exposure(scene)),
        ..*settings
    };
    (settings, alignment, &scene.shutter_profile)
}

/// The provenance of a render, as its file states it.
pub(crate) fn provenance(
    stage: &Stage,
    seed: u64,
    samples_per_pixel: u32,
    replicates: u32,
    content_hash: String,
) -> Provenance {
    Provenance {
        scene: stage.scene.id.to_string(),
        program: PROGRAM.into(),
        seed,
        samples_per_pixel,
        replicates,
        traversal: stage.traversal().into(),
        content_hash,
        engine: None,
    }
}

/// Hashes the debug output of the settings. It has every field, and every number in full, so
/// that no new setting is forgotten.
fn content_hash(scene: &Scene, kind: &str, settings: &dyn Debug) -> String {
    let tracer = env!("SOURCE_HASH");
    let [bvh, scenes] = [bvh::SOURCE_HASH, scene::SOURCE_HASH];
    let mut text = format!(
        "{PROGRAM}\n{tracer}\n{bvh}\n{scenes}\n{kind}\n{}\n{settings:?}",
        scene.hash
    );
    // The scene's own hash covers its lens, but not its removal.
    if let Some(lens) = scene.camera.lens {
        text += &format!("\n{lens:?}");
    }
    blake3::hash(text.as_bytes()).to_hex().to_string()
}
