//! The mask of what a blur leaves alone, next to the frame that it belongs to.

use std::ops::Deref;

use frame::{Frame, Plane};
use tracer::{Parent, Scene};

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

/// Draws the mask of a frame of a scene: its objects that are attached to the camera, such as a weapon or a dashboard.
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
