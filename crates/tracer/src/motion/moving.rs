//! What moves on screen while the shutter is open.

use frame::Shutter;
use glam::{DAffine3, DVec3};

use crate::geometry::aabb::Bounds;
use crate::motion::sweep::{chain, key_times};
use crate::scene::Scene;

/// Times looked at beside the shutter's ends and the keys inside it.
const LOOKS: u32 = 61;
/// The fractional part of the golden ratio: its multiples fall in step with no periodic motion.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// A change of position below this part of the scene's size is rounding.
const ROUNDING: f64 = 1e-9;

/// Per object id, whether it moves relative to the camera within the shutter. The background, at infinity, moves
/// when the camera turns; everything does when the field of view changes.
pub(crate) fn moving_objects(scene: &Scene, shutter: Shutter) -> Vec<bool> {
    let camera = &scene.camera.motion;
    let times = look_times(scene, None, shutter);
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
        changes(&look_times(scene, Some(object), shutter), |time| {
            let seen = seen_from_camera(scene, object, time);
            let place = |point| seen.transform_point3(point);
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

/// From the object's space to the camera's.
fn seen_from_camera(scene: &Scene, object: usize, time: f64) -> DAffine3 {
    scene.camera.motion.at(time).inverse() * scene.object_to_world(object, time)
}

fn mesh_corners(scene: &Scene, object: usize) -> [DVec3; 8] {
    let mesh = &scene.meshes[scene.objects[object].mesh];
    let bounds = Bounds::around(mesh.positions.iter().map(|position| position.as_dvec3()));
    std::array::from_fn(|corner| {
        let side = |bit: usize| if corner >> bit & 1 == 1 { 1.0 } else { 0.0 };
        bounds.min + (bounds.max - bounds.min) * DVec3::new(side(0), side(1), side(2))
    })
}

fn look_times(scene: &Scene, object: Option<usize>, shutter: Shutter) -> Vec<f64> {
    let motions = object
        .map(|object| chain(scene, object))
        .unwrap_or_default()
        .into_iter()
        .chain([&scene.camera.motion]);
    let mut times = key_times(motions, shutter.open, shutter.close);
    let mesh = object.map(|object| &scene.meshes[scene.objects[object].mesh]);
    let shapes = mesh.into_iter().flat_map(|mesh| mesh.shape_times());
    times.extend(shapes.filter(|time| shutter.open < *time && *time < shutter.close));
    times.extend((1..=LOOKS).map(|look| shutter.at((f64::from(look) * GOLDEN).fract())));
    times
}

/// Whether any point is elsewhere at any of the times than at the first.
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
