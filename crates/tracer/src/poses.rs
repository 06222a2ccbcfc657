//! Where everything is at the time of one path: computed when first asked for, kept for all its bounces.

use std::sync::Arc;

use glam::DAffine3;

use crate::motion::Path;
use crate::scene::{Parent, Scene};
use crate::swept::{chain, key_times};

/// An object's place at one time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    pub to_world: DAffine3,
    pub to_object: DAffine3,
}

/// The poses of all objects at one time.
#[derive(Clone)]
pub struct Poses<'a> {
    scene: &'a Scene,
    paths: Arc<Paths>,
    time: f64,
    /// Per object; valid when its stamp is the current one, or for ever.
    poses: Vec<(Stamp, Pose)>,
    current: Stamp,
    /// Room for the children of tree nodes that wait while a ray is in another. Kept here because clearing such room for
    /// every ray takes a twentieth of its time.
    pub(crate) waiting: Vec<u64>,
}

/// Every motion of a scene.
struct Paths {
    camera: Path,
    /// Per object, relative to its parent.
    objects: Vec<Path>,
}

type Stamp = u64;
const FOR_EVER: Stamp = Stamp::MAX;

impl Pose {
    fn new(to_world: DAffine3) -> Self {
        Self {
            to_world,
            to_object: to_world.inverse(),
        }
    }
}

impl<'a> Poses<'a> {
    /// Objects that stand still in `[from, to]` are posed once; times asked for later must lie in that interval.
    pub(crate) fn new(scene: &'a Scene, from: f64, to: f64) -> Self {
        let poses = (0..scene.objects.len())
            .map(|object| {
                let pose = Pose::new(scene.object_to_world(object, from));
                if from == to || stands_still(scene, object, from, to) {
                    (FOR_EVER, pose)
                } else {
                    (0, pose)
                }
            })
            .collect();
        let objects = scene.objects.iter();
        let paths = Paths {
            camera: scene.camera.motion.path(),
            objects: objects.map(|object| object.motion.path()).collect(),
        };
        Self {
            scene,
            paths: Arc::new(paths),
            time: from,
            poses,
            current: 1,
            waiting: Vec::new(),
        }
    }

    /// Whether no object ever moves.
    pub(crate) fn stand_still(&self) -> bool {
        self.poses.iter().all(|(stamp, _)| *stamp == FOR_EVER)
    }

    /// Moves to another time; returns itself.
    pub fn at(&mut self, time: f64) -> &mut Self {
        self.time = time;
        self.current += 1;
        self
    }

    /// Frames relative to the instant.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Room for so many; to be put back into `waiting` after the walk.
    #[inline(always)]
    pub(crate) fn take_waiting(&mut self, most: usize) -> Vec<u64> {
        let mut waiting = std::mem::take(&mut self.waiting);
        if waiting.len() < most {
            waiting.resize(most, 0);
        }
        waiting
    }

    #[inline]
    pub(crate) fn pose(&mut self, object: usize) -> &Pose {
        let stamp = self.poses[object].0;
        if stamp != FOR_EVER && stamp != self.current {
            let own = self.paths.objects[object].at(self.time);
            let to_world = match self.scene.objects[object].parent {
                Parent::World => own,
                Parent::Camera => self.paths.camera.at(self.time) * own,
                Parent::Object(parent) => self.pose(parent).to_world * own,
            };
            self.poses[object] = (self.current, Pose::new(to_world));
        }
        &self.poses[object].1
    }
}

/// Whether no motion between the object and the world changes anything within the interval.
fn stands_still(scene: &Scene, object: usize, from: f64, to: f64) -> bool {
    chain(scene, object).into_iter().all(|motion| {
        key_times([motion], from, to)
            .windows(2)
            .all(|span| motion.segment(0.5 * (span[0] + span[1])).stands_still())
    })
}
