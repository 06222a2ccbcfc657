//! Screen velocity of a visible point, from its exact position as a function of time.

use frame::{Camera, Reprojection, VelocityKind};
use glam::DVec3;

use crate::geometry::ray::Hit;
use crate::motion::camera::{Target, ViewRate};
use crate::scene::Scene;

/// Motion and points of a velocity buffer: the right ones, or a broken buffer's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointMotion {
    /// Time at which the points are seen at the pixels' centres, in frames.
    pub seen_at: f64,
    /// Time of the motion, in frames.
    pub moved_at: f64,
    /// Time since the place before, in frames; below 0 up to the place after.
    pub over: f64,
    /// True if the camera stands still.
    pub camera_stands: bool,
    /// Place of the objects one frame earlier.
    pub objects_before: ObjectsBefore,
    /// True if movers show through everything that stands still, as without a depth test.
    pub through_walls: bool,
}

impl PointMotion {
    /// The right motion.
    pub const RIGHT: Self = Self {
        seen_at: 0.0,
        moved_at: 0.0,
        over: 1.0,
        camera_stands: false,
        objects_before: ObjectsBefore::Own,
        through_walls: false,
    };
    /// The right motion, with movers in front of what hides them.
    pub const THROUGH_WALLS: Self = Self {
        through_walls: true,
        ..Self::RIGHT
    };
    /// Each point's motion from two frames ago to one frame ago.
    pub const FRAME_LATE: Self = Self {
        moved_at: -1.0,
        ..Self::RIGHT
    };
    /// Each point's motion to the next frame.
    pub const FRAME_EARLY: Self = Self {
        moved_at: 1.0,
        ..Self::RIGHT
    };
    /// The motion to the next frame, of points that are followed from now.
    pub(crate) const TO_NEXT: Self = Self {
        over: -1.0,
        ..Self::RIGHT
    };
    /// The whole buffer of the frame before.
    pub const PREVIOUS_BUFFER: Self = Self {
        seen_at: -1.0,
        ..Self::FRAME_LATE
    };
    /// The right motion at the place where the frame before showed the point.
    pub const PREVIOUS_PIXEL: Self = Self {
        seen_at: -1.0,
        ..Self::RIGHT
    };
    /// The camera's motion alone.
    pub const WITHOUT_OBJECTS: Self = Self {
        objects_before: ObjectsBefore::Now,
        ..Self::RIGHT
    };
    /// The objects' motion alone.
    pub const WITHOUT_CAMERA: Self = Self {
        camera_stands: true,
        ..Self::RIGHT
    };
    /// Objects come from the origin: their last matrix was never set.
    pub const MATRIX_NEVER_SET: Self = Self {
        objects_before: ObjectsBefore::Identity,
        ..Self::RIGHT
    };
}

/// Place of the objects one frame earlier, as an engine knows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObjectsBefore {
    /// Their own.
    Own,
    /// Their place now, as if they stood still.
    Now,
    /// No place: their matrix is still the identity, so that they were at the origin, not turned and not scaled.
    Identity,
}

/// A visible point, followed through time.
pub(crate) enum TrackedPoint {
    /// A point of an object's surface.
    Surface(Hit),
    /// A direction of the background, in the world.
    Infinity(DVec3),
}

impl TrackedPoint {
    /// The point that the camera ray in `direction` met.
    pub fn of(hit: Option<Hit>, direction: DVec3) -> Self {
        hit.map_or(TrackedPoint::Infinity(direction), TrackedPoint::Surface)
    }

    /// Pixels per frame at the time of the motion, +x right, +y down; then metres per frame away from the camera.
    ///
    /// The derivative is taken from the left. At a key on that time, where a motion may have a corner, that is the side that
    /// an engine sees, which compares with the frame before. A point that is behind the camera at the other frame has no
    /// position there and gets the derivative. The motion to a place after is a difference for every kind. What stands still
    /// under a still camera has a velocity of exactly 0.
    pub fn velocity(
        &self,
        scene: &Scene,
        size: [u32; 2],
        kind: VelocityKind,
        motion: &PointMotion,
    ) -> [f64; 3] {
        let now = motion.moved_at;
        let at = |time: f64| self.project(scene, size, time, motion);
        let frame_difference = || {
            let passed = difference(at(now)?, at(now - motion.over)?);
            Some(passed.map(|part| part * motion.over.signum()))
        };
        let derivative = || self.derivative(scene, size, motion);
        // Matrices that were never set make a jump, which has no derivative.
        let velocity = match (kind, motion.objects_before) {
            (_, ObjectsBefore::Identity) => frame_difference(),
            (VelocityKind::Instantaneous, _) if motion.over > 0.0 => derivative(),
            _ => frame_difference().or_else(derivative),
        };
        // Adding 0 makes -0 to 0, which has another direction.
        velocity.unwrap_or([0.0; 3]).map(|part| part + 0.0)
    }

    /// The derivative of [`TrackedPoint::project`] at the time of the motion, from the left; none behind the camera.
    fn derivative(
        &self,
        scene: &Scene,
        [width, height]: [u32; 2],
        motion: &PointMotion,
    ) -> Option<[f64; 3]> {
        let now = motion.moved_at;
        let view = scene.camera.view(now, width, height);
        let view_rate = if motion.camera_stands {
            ViewRate::STILL
        } else {
            scene.camera.view_rate_before(now, &view)
        };
        let (target, velocity) = match *self {
            TrackedPoint::Surface(hit) => {
                let (point, velocity) = surface_motion(scene, &hit, now);
                let velocity = match motion.objects_before {
                    ObjectsBefore::Now => DVec3::ZERO,
                    ObjectsBefore::Own | ObjectsBefore::Identity => velocity,
                };
                (Target::Point(point), velocity)
            }
            TrackedPoint::Infinity(direction) => (Target::Infinity(direction), DVec3::ZERO),
        };
        view.velocity_of(target, velocity, &view_rate)
    }

    /// The place in the picture at `time` (frames), in pixels, and the depth in metres, 0 at infinity; none behind the camera.
    fn project(
        &self,
        scene: &Scene,
        [width, height]: [u32; 2],
        time: f64,
        motion: &PointMotion,
    ) -> Option<[f64; 3]> {
        let now = motion.moved_at;
        let camera_time = if motion.camera_stands { now } else { time };
        let view = scene.camera.view(camera_time, width, height);
        let (target, depth) = match *self {
            TrackedPoint::Surface(hit) => {
                let object_time = match motion.objects_before {
                    ObjectsBefore::Now => now,
                    ObjectsBefore::Own | ObjectsBefore::Identity => time,
                };
                let mesh = &scene.meshes[scene.objects[hit.object].mesh];
                let point = mesh.at(object_time).point(hit.triangle, hit.weights);
                let is_unset = motion.objects_before == ObjectsBefore::Identity && time < now;
                let to_world = || scene.object_to_world(hit.object, object_time);
                let point = match is_unset {
                    true => point,
                    false => to_world().transform_point3(point),
                };
                (Target::Point(point), view.depth(point))
            }
            TrackedPoint::Infinity(direction) => (Target::Infinity(direction), 0.0),
        };
        let [x, y] = view.project(target)?;
        Some([x, y, depth])
    }
}

/// The place of a point of a surface in the world at `time` (frames), and its velocity just before, metres per frame.
fn surface_motion(scene: &Scene, hit: &Hit, time: f64) -> (DVec3, DVec3) {
    let mesh = &scene.meshes[scene.objects[hit.object].mesh];
    let point = mesh.at(time).point(hit.triangle, hit.weights);
    let velocity = mesh.velocity_before(time, hit.triangle, hit.weights);
    let outwards = scene.motion_chain(hit.object).into_iter();
    outwards.fold((point, velocity), |(point, velocity), motion| {
        let pose = motion.at(time);
        let rate = motion.rate_before(time);
        (
            pose.transform_point3(point),
            rate.transform_point3(point) + pose.transform_vector3(velocity),
        )
    })
}

/// The map from this frame's picture to the last one's, for points that stand still in the world.
pub(crate) fn reprojection(scene: &Scene, [width, height]: [u32; 2]) -> Reprojection {
    let [now, then] = [0.0, -1.0].map(|time| scene.camera.view(time, width, height));
    if now == then {
        // Without rounding, so that a point keeps its place exactly.
        return Reprojection::STILL;
    }
    Reprojection {
        rows: now.to_picture_of(&then),
    }
}

/// The camera at the instant and one frame before.
pub(crate) fn camera(scene: &Scene, [width, height]: [u32; 2]) -> Camera {
    let [now, before] = [0.0, -1.0].map(|time| scene.camera.view(time, width, height).pose());
    Camera { now, before }
}

/// The velocity that an engine without a velocity buffer rebuilds: the motion since the frame before of a point that
/// stands still in the world, at `depth` (metres, infinite for the background) under a pixel centre. Zero for a point that
/// was behind the camera then.
pub(crate) fn camera_velocity(
    reprojection: &Reprojection,
    centre: [f64; 2],
    depth: f64,
) -> [f64; 2] {
    let before = reprojection.place(centre, depth);
    before.map_or([0.0, 0.0], |before| difference(centre, before))
}

/// The earliest time that a velocity depends on, in frames.
pub(crate) fn earliest_time(kind: VelocityKind) -> f64 {
    match kind {
        VelocityKind::Instantaneous => 0.0,
        VelocityKind::PreviousFrame | VelocityKind::CameraOnly => -1.0,
    }
}

fn difference<const N: usize>(a: [f64; N], b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}
