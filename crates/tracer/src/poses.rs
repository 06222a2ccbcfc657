//! Where everything is at the time of one path: computed when first asked for, kept for all its bounces.

use std::sync::Arc;

use glam::DAffine3;

use crate::scene::{Parent, Scene};
use crate::track::Track;

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
    tracks: Arc<Tracks>,
    time: f64,
    /// Per object; valid when its stamp is the current one, or for ever.
    poses: Vec<(Stamp, Pose)>,
    current: Stamp,
}

/// The motions of everything.
struct Tracks {
    camera: Track,
    objects: Vec<Track>,
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
        let tracks = Tracks {
            camera: Track::of(&scene.camera.motion, from, to),
            objects: (scene.objects.iter())
                .map(|object| Track::of(&object.motion, from, to))
                .collect(),
        };
        let poses = (0..scene.objects.len())
            .map(|object| {
                let pose = Pose::new(scene.object_to_world(object, from));
                if tracks.stands_still(scene, object) || from == to {
                    (FOR_EVER, pose)
                } else {
                    (0, pose)
                }
            })
            .collect();
        Self {
            scene,
            tracks: Arc::new(tracks),
            time: from,
            poses,
            current: 1,
        }
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

    #[inline]
    pub(crate) fn pose(&mut self, object: usize) -> &Pose {
        let stamp = self.poses[object].0;
        if stamp != FOR_EVER && stamp != self.current {
            let own = self.tracks.objects[object].at(self.time);
            let to_world = match self.scene.objects[object].parent {
                Parent::World => own,
                Parent::Camera => self.tracks.camera.at(self.time) * own,
                Parent::Object(parent) => self.pose(parent).to_world * own,
            };
            self.poses[object] = (self.current, Pose::new(to_world));
        }
        &self.poses[object].1
    }
}

impl Tracks {
    /// Whether no motion between the object and the world changes anything.
    fn stands_still(&self, scene: &Scene, object: usize) -> bool {
        let above = match scene.objects[object].parent {
            Parent::World => true,
            Parent::Camera => self.camera.stands_still(),
            Parent::Object(parent) => self.stands_still(scene, parent),
        };
        above && self.objects[object].stands_still()
    }
}
