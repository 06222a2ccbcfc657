//! Frames of scenes.

use std::path::Path;

use frame::Frame;
use store::{RenderFile, refuse_scene, scene_folder};
use tracer::{RenderSettings, Scene};

use super::memory::check_memory;
use super::settings::frame_settings;
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
    let own = frame_settings(settings);
    let path = folder.join(RenderFile::Frame.path());
    let hash = tracer::frame_hash(scene, &own);
    if let Ok(found) = Frame::read(&path)
        && found.provenance.is_rendered_of(&hash)
    {
        return Ok(found);
    }
    own.check_frame(scene)?;
    check_memory(scene, settings, settings.replicates)?;
    let label = format!("{} frame", scene.id);
    let frame = monitor.watch(&label, |watch| tracer::trace_frame(scene, &own, watch))?;
    assert_eq!(
        frame.provenance.content_hash, hash,
        "{label}: the hash must not depend on the render"
    );
    frame.write(&path)?;
    Ok(frame)
}
