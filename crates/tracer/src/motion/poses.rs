//! Where everything is at the time of one path: computed when first asked for, kept for all its bounces.

use std::sync::Arc;

use glam::DAffine3;

use crate::geometry::ray::Ray;
use crate::motion::keys::{Motion, Segment};
use crate::motion::screw::Screw;
use crate::motion::sweep::{chain, key_times};
use crate::scene::{Mesh, Parent, Scene};

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
    ways: Arc<Ways>,
    time: f64,
    /// Per object; valid when its stamp is the current one, or for ever.
    poses: Vec<(Stamp, Pose)>,
    current: Stamp,
    /// Room for the children of tree nodes that wait while a ray is in another. Kept here because clearing such room for
    /// every ray takes a twentieth of its time.
    pub(crate) waiting: Vec<u64>,
}

/// Every motion of a scene.
struct Ways {
    camera: Way,
    /// Per object, relative to its parent.
    objects: Vec<Way>,
    /// Per object, how far its mesh reaches from its origin, metres; infinite where that changes.
    reaches: Vec<f64>,
}

/// A motion whose stretches are worked out once, for poses at many times.
struct Way {
    /// Of the keys, in frames.
    times: Vec<f64>,
    /// Before the first key, and from each key on.
    stretches: Vec<Stretch>,
}

enum Stretch {
    Screw(Screw),
    Other(Segment),
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

    /// Of what stands at `own` in a space that stands at this pose.
    fn carrying(&self, own: &Pose) -> Self {
        Self {
            to_world: self.to_world * own.to_world,
            to_object: own.to_object * self.to_object,
        }
    }
}

impl Way {
    fn of(motion: &Motion) -> Self {
        Self {
            times: motion.keys.iter().map(|key| key.time).collect(),
            stretches: motion
                .segments()
                .map(|segment| match Screw::of(&segment) {
                    Some(screw) => Stretch::Screw(screw),
                    None => Stretch::Other(segment),
                })
                .collect(),
        }
    }

    fn stretch(&self, time: f64) -> &Stretch {
        &self.stretches[self.times.partition_point(|key| *key <= time)]
    }

    /// As [`Motion::at`].
    fn at(&self, time: f64) -> Pose {
        match self.stretch(time) {
            Stretch::Screw(screw) => screw.at(time),
            Stretch::Other(segment) => Pose::new(segment.at(time)),
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
        let reaches: Vec<f64> = scene.meshes.iter().map(reach).collect();
        let objects = scene.objects.iter();
        let ways = Ways {
            camera: Way::of(&scene.camera.motion),
            reaches: objects.clone().map(|object| reaches[object.mesh]).collect(),
            objects: objects.map(|object| Way::of(&object.motion)).collect(),
        };
        Self {
            scene,
            ways: Arc::new(ways),
            time: from,
            poses,
            current: 1,
            waiting: Vec::new(),
        }
    }

    /// Whether an object never moves.
    pub(crate) fn stands_still(&self, object: usize) -> bool {
        self.poses[object].0 == FOR_EVER
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

    /// Whether a ray certainly misses an object, told without its pose where that is not yet known.
    #[inline(always)]
    pub(crate) fn missed(&self, object: usize, ray: &Ray) -> bool {
        let stamp = self.poses[object].0;
        if stamp == FOR_EVER || stamp == self.current {
            return false;
        }
        match (
            self.scene.objects[object].parent,
            self.ways.objects[object].stretch(self.time),
        ) {
            (Parent::World, Stretch::Screw(screw)) => {
                let reach = self.ways.reaches[object];
                screw.ball(reach, self.time).is_missed(ray)
            }
            _ => false,
        }
    }

    #[inline]
    pub(crate) fn pose(&mut self, object: usize) -> &Pose {
        if !self.is_current(object) {
            self.pose_anew(object);
        }
        &self.poses[object].1
    }

    /// Whether an object's pose is that of the current time.
    #[inline]
    fn is_current(&self, object: usize) -> bool {
        let stamp = self.poses[object].0;
        stamp == FOR_EVER || stamp == self.current
    }

    /// Poses an object, and before it those of its parents that are not yet posed. Chains of parents may be longer than a
    /// thread's stack.
    fn pose_anew(&mut self, object: usize) {
        let mut due = Vec::new();
        let mut outermost = object;
        while let Parent::Object(parent) = self.scene.objects[outermost].parent
            && !self.is_current(parent)
        {
            due.push(outermost);
            outermost = parent;
        }
        self.pose_one(outermost);
        for object in due.into_iter().rev() {
            self.pose_one(object);
        }
    }

    /// Poses an object whose parent is posed.
    fn pose_one(&mut self, object: usize) {
        let own = self.ways.objects[object].at(self.time);
        let pose = match self.scene.objects[object].parent {
            Parent::World => own,
            Parent::Camera => self.ways.camera.at(self.time).carrying(&own),
            Parent::Object(parent) => self.poses[parent].1.carrying(&own),
        };
        self.poses[object] = (self.current, pose);
    }
}

/// The greatest distance of a vertex from the origin, metres; infinite where the mesh deforms.
fn reach(mesh: &Mesh) -> f64 {
    if mesh.deforms() {
        return f64::INFINITY;
    }
    let lengths = mesh.positions.iter().map(|p| p.as_dvec3().length());
    lengths.fold(0.0, f64::max)
}

/// Whether no motion between the object and the world changes anything within the interval.
fn stands_still(scene: &Scene, object: usize, from: f64, to: f64) -> bool {
    chain(scene, object).into_iter().all(|motion| {
        key_times([motion], from, to)
            .windows(2)
            .all(|span| motion.segment(0.5 * (span[0] + span[1])).stands_still())
    })
}
