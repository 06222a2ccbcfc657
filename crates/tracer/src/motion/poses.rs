//! The poses of all objects at the time of one path, computed when first asked for and kept for all
//! bounces.

use std::sync::Arc;

use bvh::Ray;
use scene::{Mesh, Motion, Parent, Scene, Segment, key_times};

use crate::motion::pose::Pose;
use crate::motion::screw::Screw;

/// The poses of all objects at one time.
#[derive(Clone)]
pub struct Poses<'a> {
    scene: &'a Scene,
    motions: Arc<PreparedMotions>,
    time: f64,
    /// Pose of each object, valid if its stamp is the current one or [`FOR_EVER`].
    poses: Vec<(Stamp, Pose)>,
    current: Stamp,
    /// Stack of the traversal. It is kept here because clearing one for every ray takes a twentieth
    /// of the ray's time.
    pub(crate) stack: Vec<u64>,
}

/// Every motion of a scene.
struct PreparedMotions {
    camera: PreparedMotion,
    /// Motion of each object, relative to its parent.
    objects: Vec<PreparedMotion>,
    /// Greatest distance of each object's vertices from its origin, metres; infinite if the mesh
    /// deforms.
    radii: Vec<f64>,
}

/// A motion whose segments are worked out once, for poses at many times.
struct PreparedMotion {
    /// Times of the keys, in frames.
    times: Vec<f64>,
    /// Segments before the first key, and from each key on.
    segments: Vec<PreparedSegment>,
}

enum PreparedSegment {
    Screw(Screw),
    Other(Segment),
}

type Stamp = u64;
const FOR_EVER: Stamp = Stamp::MAX;

impl PreparedMotion {
    fn new(motion: &Motion) -> Self {
        Self {
            times: motion.keys.iter().map(|key| key.time).collect(),
            segments: motion
                .segments()
                .map(|segment| match Screw::of(&segment) {
                    Some(screw) => PreparedSegment::Screw(screw),
                    None => PreparedSegment::Other(segment),
                })
                .collect(),
        }
    }

    fn segment(&self, time: f64) -> &PreparedSegment {
        &self.segments[self.times.partition_point(|key| *key <= time)]
    }

    /// The pose of [`Motion::at`].
    fn at(&self, time: f64) -> Pose {
        match self.segment(time) {
            PreparedSegment::Screw(screw) => screw.at(time),
            PreparedSegment::Other(segment) => Pose::new(segment.at(time)),
        }
    }
}

impl<'a> Poses<'a> {
    /// Prepares all motions for times within `[from, to]`. Objects that stand still there are posed
    /// once.
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
        let radius = |mesh: &Mesh| {
            if mesh.deforms() {
                f64::INFINITY
            } else {
                mesh.at(from).radius()
            }
        };
        let radii: Vec<f64> = scene.meshes.iter().map(radius).collect();
        let objects = scene.objects.iter();
        let motions = PreparedMotions {
            camera: PreparedMotion::new(&scene.camera.motion),
            radii: objects.clone().map(|object| radii[object.mesh]).collect(),
            objects: objects
                .map(|object| PreparedMotion::new(&object.motion))
                .collect(),
        };
        Self {
            scene,
            motions: Arc::new(motions),
            time: from,
            poses,
            current: 1,
            stack: Vec::new(),
        }
    }

    /// Returns true if an object never moves.
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

    /// Takes out the stack, of at least this size. The traversal puts it back into `stack`.
    #[inline(always)]
    pub(crate) fn take_stack(&mut self, size: usize) -> Vec<u64> {
        let mut stack = std::mem::take(&mut self.stack);
        if stack.len() < size {
            stack.resize(size, 0);
        }
        stack
    }

    /// Returns true if a ray certainly misses an object. It is a quick test of objects whose pose
    /// is not yet known.
    #[inline(always)]
    pub(crate) fn is_missed(&self, object: usize, ray: &Ray) -> bool {
        if self.is_current(object) {
            return false;
        }
        match (
            self.scene.objects[object].parent,
            self.motions.objects[object].segment(self.time),
        ) {
            (Parent::World, PreparedSegment::Screw(screw)) => {
                let radius = self.motions.radii[object];
                screw.ball(radius, self.time).is_missed(ray)
            }
            _ => false,
        }
    }

    #[inline]
    pub(crate) fn pose(&mut self, object: usize) -> &Pose {
        if !self.is_current(object) {
            self.update(object);
        }
        &self.poses[object].1
    }

    /// Returns true if an object's pose is of the current time.
    #[inline]
    fn is_current(&self, object: usize) -> bool {
        let stamp = self.poses[object].0;
        stamp == FOR_EVER || stamp == self.current
    }

    /// Poses an object, and before it those of its parents that are out of date. A loop, because
    /// chains of parents may be deeper than a thread's stack.
    fn update(&mut self, object: usize) {
        let mut outdated = Vec::new();
        let mut outermost = object;
        while let Parent::Object(parent) = self.scene.objects[outermost].parent
            && !self.is_current(parent)
        {
            outdated.push(outermost);
            outermost = parent;
        }
        self.update_one(outermost);
        for object in outdated.into_iter().rev() {
            self.update_one(object);
        }
    }

    /// Poses an object whose parent is up to date.
    fn update_one(&mut self, object: usize) {
        let motion = self.motions.objects[object].at(self.time);
        let pose = match self.scene.objects[object].parent {
            Parent::World => motion,
            Parent::Camera => self.motions.camera.at(self.time).compose(&motion),
            Parent::Object(parent) => self.poses[parent].1.compose(&motion),
        };
        self.poses[object] = (self.current, pose);
    }
}

/// Returns true if no motion between the object and the world changes anything within the interval.
fn stands_still(scene: &Scene, object: usize, from: f64, to: f64) -> bool {
    scene.motion_chain(object).into_iter().all(|motion| {
        key_times([motion], from, to)
            .windows(2)
            .all(|span| motion.segment(0.5 * (span[0] + span[1])).stands_still())
    })
}
