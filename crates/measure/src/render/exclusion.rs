//! The mask of what a blur leaves alone, next to the frame that it belongs to.

use std::ops::Deref;
use std::path::Path;

use filters::EXCLUSION;
use frame::{ExrFile, FileError, Frame, Plane, read_exr, write_exr};
use scene::{Parent, Scene};

/// Name of the mask's file in the folder of a scene.
pub const EXCLUSION_FILE: &str = "exclusion.exr";

/// A frame with the mask that few filters read.
pub struct FilterFrame {
    /// The frame; its fields are read through this one.
    pub frame: Frame,
    /// 1 on excluded objects, 0 elsewhere; none if no filter reads it.
    pub exclusion: Option<Plane>,
}

impl Deref for FilterFrame {
    type Target = Frame;

    fn deref(&self) -> &Frame {
        &self.frame
    }
}

/// Draws the mask of a frame of a scene: its objects that are attached to the camera, such as a
/// weapon or a dashboard.
pub(crate) fn draw_exclusion(frame: &Frame, scene: &Scene) -> Plane {
    (frame.object_id).map(|id| f32::from(*id > 0 && follows_camera(scene, *id as usize - 1)))
}

/// Tells whether an object is attached to the camera, directly or by a parent.
fn follows_camera(scene: &Scene, object: usize) -> bool {
    match scene.objects[object].parent {
        Parent::World => false,
        Parent::Camera => true,
        Parent::Object(parent) => follows_camera(scene, parent),
    }
}

/// Writes the mask of a frame to the folder of its scene, so that a page can show what filters got.
pub(crate) fn write_exclusion(mask: &Plane, frame: &Frame, folder: &Path) -> Result<(), FileError> {
    let mut file = ExrFile::new(mask.width, mask.height);
    file.push_plane(EXCLUSION, mask);
    file.set("kind", EXCLUSION);
    file.set("content_hash", &frame.provenance.content_hash);
    write_exr(&folder.join(EXCLUSION_FILE), &file)
}

/// Reads the mask that a run wrote for the same frame, if the scene's folder has one.
pub fn read_exclusion(frame: &Frame, folder: &Path) -> Result<Option<Plane>, FileError> {
    let path = folder.join(EXCLUSION_FILE);
    if !path.is_file() {
        return Ok(None);
    }
    let file = read_exr(&path)?;
    let hash: String = file.get("content_hash")?;
    let is_own = hash == frame.provenance.content_hash && file.size() == frame.size();
    is_own.then(|| file.plane(EXCLUSION)).transpose()
}
