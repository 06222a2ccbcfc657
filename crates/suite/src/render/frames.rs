//! Frames of scenes.

use std::path::Path;

use frame::Frame;
use tracer::Scene;

use super::cached_file::CachedFile;
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
    let file = CachedFile {
        path: folder.join("frame.exr"),
        label: format!("{} frame", scene.name),
        hash: tracer::frame_hash(scene, &frame_settings),
    };
    file.read_or_render(
        monitor,
        |watch| {
            frame_settings.check(scene)?;
            check_memory(scene, settings, settings.replicates)?;
            Ok(tracer::trace_frame(scene, &frame_settings, watch)?)
        },
        (Frame::read, Frame::write, |frame| {
            &frame.provenance.content_hash
        }),
    )
}
