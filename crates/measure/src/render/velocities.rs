//! Velocities that few filters read, added to a frame, and their file.

use std::path::Path;

use frame::{ExrFile, FileError, Frame, Size, read_exr, write_exr};
use scene::Scene;
use tracer::{PixelGrid, RenderSettings, trace_further_velocities};

use crate::Error;

/// Adds the motion to the next frame and the change of depth to a frame of a scene that lacks one
/// of them: two rays per pixel. `settings` and `grid` are those that the frame was rendered with.
pub(crate) fn add_further_velocities(
    frame: Frame,
    scene: &Scene,
    settings: &RenderSettings,
    grid: &PixelGrid,
) -> Result<Frame, Error> {
    if frame.velocity_next.is_some() && frame.velocity_z.is_some() {
        return Ok(frame);
    }
    let (next, z) = trace_further_velocities(scene, settings, grid)?;
    Ok(Frame {
        velocity_next: Some(next),
        velocity_z: Some(z),
        ..frame
    })
}

/// File of the velocities, in the folder of the scene.
const FILE: &str = "further_velocities.exr";

/// Writes the velocities of a frame that has them, so that a page can show what filters got. The
/// frame's own file stays without them, since runs of other filters share it.
pub(crate) fn write_further_velocities(frame: &Frame, folder: &Path) -> Result<(), FileError> {
    let Size { width, height } = frame.size();
    let mut file = ExrFile::new(width, height);
    if let (Some(next), Some(z)) = (&frame.velocity_next, &frame.velocity_z) {
        file.push_vectors("velocity_next", next);
        file.push_plane("velocity_z", z);
    }
    file.set("kind", "further_velocities");
    file.set("content_hash", &frame.provenance.content_hash);
    write_exr(&folder.join(FILE), &file)
}

/// Reads velocities that a run wrote for the same frame. Changes nothing if the scene's folder has
/// none.
pub fn read_further_velocities(frame: &mut Frame, folder: &Path) -> Result<(), FileError> {
    let path = folder.join(FILE);
    if !path.is_file() {
        return Ok(());
    }
    let file = read_exr(&path)?;
    let hash: String = file.get("content_hash")?;
    if hash == frame.provenance.content_hash && file.size() == frame.size() {
        frame.velocity_next = Some(file.vectors("velocity_next")?);
        frame.velocity_z = Some(file.plane("velocity_z")?);
    }
    Ok(())
}
