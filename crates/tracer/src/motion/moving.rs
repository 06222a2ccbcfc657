//! The objects that move on screen while the shutter is open.

use bvh::Aabb;
use frame::Shutter;
use glam::{DAffine3, DVec3};
use scene::{Scene, times_within};

/// Times examined besides the shutter's ends and the keys inside it.
const EXTRA_TIMES: u32 = 61;
/// Fractional part of the golden ratio. Its multiples fall in step with no periodic motion.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Part of the scene's size below which a change of position is rounding.
const ROUNDING: f64 = 1e-9;

/// Finds per object id whether it moves relative to the camera while the shutter is open. The
/// background, at infinity, moves when the camera turns. Everything moves when the field of view
/// changes.
pub(crate) fn find_moving_objects(scene: &Scene, shutter: Shutter) -> Vec<bool> {
    let camera = &scene.camera.motion;
    let times = sample_times(scene, None, shutter);
    let zooms = changes(&times, |time| {
        vec![DVec3::splat(scene.camera.vertical_fov_at(time))]
    });
    let background = changes(&times, |time| {
        let axes = camera.at(time).matrix3;
        vec![axes.x_axis, axes.y_axis, axes.z_axis]
    });
    let objects = (0..scene.objects.len()).map(|object| {
        let corners = mesh_corners(scene, object);
        let mesh = &scene.meshes[scene.objects[object].mesh];
        changes(&sample_times(scene, Some(object), shutter), |time| {
            let to_camera = object_to_camera(scene, object, time);
            let place = |point| to_camera.transform_point3(point);
            if mesh.deforms() {
                mesh.at(time).positions().map(place).collect()
            } else {
                corners.map(place).to_vec()
            }
        })
    });
    std::iter::once(background)
        .chain(objects)
        .map(|moves| moves || zooms)
        .collect()
}

/// The transform from the object's space to the camera's.
fn object_to_camera(scene: &Scene, object: usize, time: f64) -> DAffine3 {
    scene.camera.motion.at(time).inverse() * scene.object_to_world(object, time)
}

fn mesh_corners(scene: &Scene, object: usize) -> [DVec3; 8] {
    let mesh = &scene.meshes[scene.objects[object].mesh];
    let aabb = Aabb::around(mesh.positions.iter().map(|position| position.as_dvec3()));
    std::array::from_fn(|corner| {
        let side = |bit: usize| if corner >> bit & 1 == 1 { 1.0 } else { 0.0 };
        aabb.min + (aabb.max - aabb.min) * DVec3::new(side(0), side(1), side(2))
    })
}

fn sample_times(scene: &Scene, object: Option<usize>, shutter: Shutter) -> Vec<f64> {
    let motions = object.map(|object| scene.motion_chain(object));
    let motions = (motions.into_iter().flatten()).chain([&scene.camera.motion]);
    let keys = motions.flat_map(|motion| &motion.keys);
    let mesh = object.map(|object| &scene.meshes[scene.objects[object].mesh]);
    let shapes = mesh.into_iter().flat_map(|mesh| mesh.shape_times());
    let key_times = keys.map(|key| key.time).chain(shapes);
    let mut times = times_within(key_times, shutter.open, shutter.close);
    times.extend((1..=EXTRA_TIMES).map(|step| shutter.at((f64::from(step) * GOLDEN).fract())));
    times
}

/// Returns true if any point moves away from its place at the first of the times.
fn changes(times: &[f64], points: impl Fn(f64) -> Vec<DVec3>) -> bool {
    let first = points(times[0]);
    let size = first.iter().map(|point| point.length()).fold(0.0, f64::max);
    times.iter().any(|&time| {
        points(time)
            .iter()
            .zip(&first)
            .any(|(now, then)| now.distance(*then) > ROUNDING * size)
    })
}
