//! The pose of an object at one time.

use glam::DAffine3;

use crate::scene::Scene;

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

impl Scene {
    /// Transform from the object's space to the world at `time` (frames).
    pub fn object_to_world(&self, object: usize, time: f64) -> DAffine3 {
        self.object_to_world_within(object, time, time)
    }

    /// The same with the object and its parents at different times.
    pub(crate) fn object_to_world_within(
        &self,
        object: usize,
        time: f64,
        parents_time: f64,
    ) -> DAffine3 {
        let times = std::iter::once(time).chain(std::iter::repeat(parents_time));
        let outwards = self.motion_chain(object).into_iter().zip(times);
        let transforms: Vec<DAffine3> = outwards.map(|(motion, time)| motion.at(time)).collect();
        (transforms.into_iter().rev())
            .reduce(|outer, inner| outer * inner)
            .expect("an object is in its own chain")
    }
}
