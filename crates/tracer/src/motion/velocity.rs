//! Screen velocity of a visible point, from its exact position as a function of time.

use frame::{Camera, Reprojection, Size, VelocityKind};
use glam::DVec3;
use scene::Scene;

use crate::hit::Hit;
use crate::motion::point_motion::{ObjectsBefore, PointMotion};
use crate::motion::view::{Target, View, ViewRate};

/// Step of the difference quotient, in frames.
const STEP: f64 = 1e-5;
/// Upper limit on the difference between the quotient and the derivative, relative to the latter
/// and at least that of one pixel or metre per frame.
const AGREEMENT: f64 = 1e-5;

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

    /// Pixels per frame at the time of the motion, +x right, +y down; then metres per frame away
    /// from the camera.
    ///
    /// The derivative is taken from the left. At a key on that time, where a motion may have a
    /// corner, that is the side that an engine sees, which compares with the frame before. A point
    /// that is behind the camera at the other frame has no position there and gets the derivative.
    /// The motion to a place after is a difference for every kind. What stands still under a still
    /// camera has a velocity of exactly 0.
    pub fn velocity(
        &self,
        scene: &Scene,
        size: Size,
        kind: VelocityKind,
        motion: &PointMotion,
    ) -> [f64; 3] {
        let now = motion.moved_at;
        let at = |time: f64| self.project(scene, size, time, motion);
        let frame_difference = || {
            let passed = difference(at(now)?, at(now - motion.over)?);
            Some(passed.map(|part| part * motion.over.signum()))
        };
        let derivative = || {
            let (view, rate) = motion.view(scene, size);
            let exact = self.derivative(scene, &view, &rate, motion)?;
            if rate.is_still() && exact == [0.0; 3] {
                return Some(exact);
            }
            // Some filters choose among equal velocities by their last digit. Published scores have
            // the quotient's, so it stays where it is right: below some hundred radians per frame.
            let quotient = self.difference_quotient(scene, size, motion);
            let right = quotient.filter(|quotient| agree(quotient, &exact));
            Some(right.unwrap_or(exact))
        };
        // Matrices that were never set make a jump, which has no derivative.
        let velocity = match (kind, motion.objects_before) {
            (_, ObjectsBefore::Identity) => frame_difference(),
            (VelocityKind::Instantaneous, _) if motion.over > 0.0 => derivative(),
            _ => frame_difference().or_else(derivative),
        };
        // Adding 0 makes -0 to 0, which has another direction.
        velocity.unwrap_or([0.0; 3]).map(|part| part + 0.0)
    }

    /// The derivative of [`TrackedPoint::project`] at the time of the motion, from the left; none
    /// behind the camera.
    fn derivative(
        &self,
        scene: &Scene,
        view: &View,
        rate: &ViewRate,
        motion: &PointMotion,
    ) -> Option<[f64; 3]> {
        let now = motion.moved_at;
        let (target, velocity) = match *self {
            TrackedPoint::Surface(hit) => {
                let moving = motion.times(now - motion.over).map(|time| time != now);
                let (point, velocity) = surface_motion(scene, &hit, now, moving);
                (Target::Point(point), velocity)
            }
            TrackedPoint::Infinity(direction) => (Target::Infinity(direction), DVec3::ZERO),
        };
        view.velocity_of(target, velocity, rate)
    }

    /// The same by places at three times; none if one of them is behind the camera.
    fn difference_quotient(
        &self,
        scene: &Scene,
        size: Size,
        motion: &PointMotion,
    ) -> Option<[f64; 3]> {
        let at = |steps: f64| self.project(scene, size, motion.moved_at - steps * STEP, motion);
        let [now, then, before] = [at(0.0)?, at(1.0)?, at(2.0)?];
        Some(std::array::from_fn(|axis| {
            (3.0 * now[axis] - 4.0 * then[axis] + before[axis]) / (2.0 * STEP)
        }))
    }

    /// The place in the picture at `time` (frames), in pixels, and the depth in metres, 0 at
    /// infinity; none behind the camera.
    fn project(
        &self,
        scene: &Scene,
        Size { width, height }: Size,
        time: f64,
        motion: &PointMotion,
    ) -> Option<[f64; 3]> {
        let now = motion.moved_at;
        let camera_time = if motion.camera_stands { now } else { time };
        let view = View::new(&scene.camera, camera_time, width, height);
        let (target, depth) = match *self {
            TrackedPoint::Surface(hit) => {
                let [shape_time, own_time, parents_time] = motion.times(time);
                let mesh = &scene.meshes[scene.objects[hit.object].mesh];
                let point = mesh.at(shape_time).point(hit.triangle, hit.weights);
                let is_unset = motion.objects_before == ObjectsBefore::Identity && time < now;
                let to_world = || scene.object_to_world_within(hit.object, own_time, parents_time);
                let point = if is_unset {
                    point
                } else {
                    to_world().transform_point3(point)
                };
                (Target::Point(point), view.depth(point))
            }
            TrackedPoint::Infinity(direction) => (Target::Infinity(direction), 0.0),
        };
        let [x, y] = view.project(target)?;
        Some([x, y, depth])
    }
}

/// The place of a point of a surface in the world at `time` (frames), and its velocity just before,
/// metres per frame, if its shape, its object and that object's parents move.
fn surface_motion(
    scene: &Scene,
    hit: &Hit,
    time: f64,
    [shape_moves, object_moves, parents_move]: [bool; 3],
) -> (DVec3, DVec3) {
    let mesh = &scene.meshes[scene.objects[hit.object].mesh];
    let point = mesh.at(time).point(hit.triangle, hit.weights);
    let deformation = || mesh.velocity_before(time, hit.triangle, hit.weights);
    let velocity = if shape_moves {
        deformation()
    } else {
        DVec3::ZERO
    };
    let moves = std::iter::once(object_moves).chain(std::iter::repeat(parents_move));
    let outwards = scene.motion_chain(hit.object).into_iter().zip(moves);
    outwards.fold((point, velocity), |(point, velocity), (motion, moves)| {
        let pose = motion.at(time);
        let carried = pose.transform_vector3(velocity);
        let velocity = if moves {
            carried + motion.rate_before(time).transform_point3(point)
        } else {
            carried
        };
        (pose.transform_point3(point), velocity)
    })
}

/// The map from this frame's picture to the last one's, for points that stand still in the world.
pub(crate) fn reprojection(scene: &Scene, Size { width, height }: Size) -> Reprojection {
    let [now, then] = [0.0, -1.0].map(|time| View::new(&scene.camera, time, width, height));
    if now == then {
        // Without rounding, so that a point keeps its place exactly.
        return Reprojection::STILL;
    }
    Reprojection {
        rows: now.to_picture_of(&then),
    }
}

/// The camera at the instant and one frame before.
pub(crate) fn camera(scene: &Scene, Size { width, height }: Size) -> Camera {
    let [now, before] =
        [0.0, -1.0].map(|time| View::new(&scene.camera, time, width, height).pose());
    Camera { now, before }
}

/// The velocity that an engine without a velocity buffer rebuilds: the motion since the frame
/// before of a point that stands still in the world, at `depth` (metres, infinite for the
/// background) under a pixel centre. Zero for a point that was behind the camera then.
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
        VelocityKind::Instantaneous => -2.0 * STEP,
        VelocityKind::PreviousFrame | VelocityKind::CameraOnly => -1.0,
    }
}

/// Returns whether two velocities and changes of depth are the same, except for errors of the
/// difference quotient.
fn agree(quotient: &[f64; 3], exact: &[f64; 3]) -> bool {
    let [right, down, away] = difference(*quotient, *exact);
    let allowed = |speed: f64| AGREEMENT * speed.max(1.0);
    right.hypot(down) <= allowed(exact[0].hypot(exact[1])) && away.abs() <= allowed(exact[2].abs())
}

fn difference<const N: usize>(a: [f64; N], b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}
