//! Frames of scenes.

use std::path::Path;

use frame::Frame;
use tracer::Scene;

use super::memory::check_memory;
use super::settings::RenderSettings;
use crate::folder::scene_folder::{refuse_scene, scene_folder};
use crate::{Error, Monitor};

/// Renders the frame of `scene` and writes it to `out`; reads it from there if its inputs are the same.
pub fn render_frame(
    scene: &Scene,
    settings: &RenderSettings,
    out: &Path,
    monitor: Monitor,
) -> Result<Frame, Error> {
    let folder = scene_folder(out, scene);
    refuse_scene(&folder)?;
    let frame_settings = settings.for_frame(scene);
    let path = folder.join("frame.exr");
    let hash = tracer::frame_hash(scene, &frame_settings);
    if let Ok(found) = Frame::read(&path)
        && found.provenance.content_hash == hash
    {
        return Ok(found);
    }
    frame_settings.check(scene)?;
    check_memory(scene, settings, settings.replicates)?;
    let label = format!("{} frame", scene.name);
    let frame = monitor.watch(&label, |watch| {
        tracer::trace_frame(scene, &frame_settings, watch)
    })?;
    assert_eq!(
        frame.provenance.content_hash, hash,
        "{label}: the hash must not depend on the render"
    );
    frame.write(&path)?;
    Ok(frame)
}
