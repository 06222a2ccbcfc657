//! The pose of an object at one time.

use glam::DAffine3;

/// The transforms between an object's space and the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    pub to_world: DAffine3,
    pub to_object: DAffine3,
}

impl Pose {
    pub fn new(to_world: DAffine3) -> Self {
        Self {
            to_world,
            to_object: to_world.inverse(),
        }
    }

    /// The pose of a child from its pose relative to this one.
    pub fn compose(&self, child: &Pose) -> Self {
        Self {
            to_world: self.to_world * child.to_world,
            to_object: child.to_object * self.to_object,
        }
    }
}
