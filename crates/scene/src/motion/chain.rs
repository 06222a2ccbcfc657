//! The motions between an object and the world.

use glam::DAffine3;

use crate::model::{Motion, Parent, Scene};

impl Scene {
    /// Transform from the object's space to the world at `time` (frames).
    pub fn object_to_world(&self, object: usize, time: f64) -> DAffine3 {
        self.object_to_world_within(object, time, time)
    }

    /// The same with the object and its parents at different times.
    pub fn object_to_world_within(&self, object: usize, time: f64, parents_time: f64) -> DAffine3 {
        let times = std::iter::once(time).chain(std::iter::repeat(parents_time));
        let outwards = self.motion_chain(object).into_iter().zip(times);
        let transforms: Vec<DAffine3> = outwards.map(|(motion, time)| motion.at(time)).collect();
        (transforms.into_iter().rev())
            .reduce(|outer, inner| outer * inner)
            .expect("an object is in its own chain")
    }

    /// Motions from the object outwards to the world.
    pub fn motion_chain(&self, object: usize) -> Vec<&Motion> {
        let mut motions = vec![&self.objects[object].motion];
        let mut parent = self.objects[object].parent;
        loop {
            match parent {
                Parent::World => return motions,
                Parent::Camera => {
                    motions.push(&self.camera.motion);
                    return motions;
                }
                Parent::Object(index) => {
                    motions.push(&self.objects[index].motion);
                    parent = self.objects[index].parent;
                }
            }
        }
    }
}
