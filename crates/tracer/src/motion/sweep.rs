//! Boxes around a moving mesh over an interval of time.

use bvh::Aabb;
use glam::DVec3;
use scene::{Mesh, Motion, Scene, Segment, times_within};

use crate::motion::extent::Extent;

/// Upper limits for all points of a mesh within an interval.
#[derive(Clone, Copy)]
struct PointMaxima {
    /// Distance from the origin, metres.
    distance: f64,
    /// Metres per frame.
    speed: f64,
    /// Metres per frame squared.
    acceleration: f64,
}

/// A box around the object's mesh at every time of `[from, to]`, in the world; `extents` are those
/// of the scene's meshes.
///
/// Between keys a point moves along a curve of an acceleration of at most `A`, and such a curve
/// strays from its chord by at most `A h^2 / 8`. The union of the boxes at both ends, grown by
/// that, contains it. Translation needs no growth.
pub(crate) fn swept_aabb(
    scene: &Scene,
    extents: &[Extent],
    object: usize,
    from: f64,
    to: f64,
) -> Aabb {
    let mesh = &scene.meshes[scene.objects[object].mesh];
    let extent = &extents[scene.objects[object].mesh];
    let at = |time: f64| extent.aabb(mesh, &scene.object_to_world(object, time), time);
    let motions = scene.motion_chain(object);
    let times = span_times(mesh, &motions, from, to);
    let first = at(from);
    let (union, _) = times
        .windows(2)
        .fold((first, first), |(union, start), span| {
            let end = at(span[1]);
            let length = span[1] - span[0];
            let sagitta = chain_maxima(&motions, mesh, extent, span[0], span[1]).acceleration
                * length
                * length
                / 8.0;
            (union.union(start.union(end).grown(sagitta)), end)
        });
    union
}

/// The greatest speed of any point of the object's mesh within `[from, to]`, metres per frame;
/// never too small.
pub(crate) fn greatest_speed(
    scene: &Scene,
    extents: &[Extent],
    object: usize,
    from: f64,
    to: f64,
) -> f64 {
    let mesh = &scene.meshes[scene.objects[object].mesh];
    let extent = &extents[scene.objects[object].mesh];
    let motions = scene.motion_chain(object);
    span_times(mesh, &motions, from, to)
        .windows(2)
        .map(|span| chain_maxima(&motions, mesh, extent, span[0], span[1]).speed)
        .fold(0.0, f64::max)
}

/// The ends of the interval, and the times inside it of the motions' keys and the mesh's key
/// shapes.
fn span_times(mesh: &Mesh, motions: &[&Motion], from: f64, to: f64) -> Vec<f64> {
    let keys = motions.iter().flat_map(|motion| &motion.keys);
    times_within(keys.map(|key| key.time).chain(mesh.shape_times()), from, to)
}

/// The limits after a chain of motions, within an interval without keys inside.
fn chain_maxima(
    motions: &[&Motion],
    mesh: &Mesh,
    extent: &Extent,
    from: f64,
    to: f64,
) -> PointMaxima {
    let [distance, speed] = if mesh.deforms() {
        mesh.vertex_maxima(from, to)
    } else {
        [extent.distance, 0.0]
    };
    let at_rest = PointMaxima {
        distance,
        speed,
        acceleration: 0.0,
    };
    motions.iter().fold(at_rest, |inner, motion| {
        segment_maxima(inner, &motion.segment(0.5 * (from + to)), from, to)
    })
}

/// The limits after one segment of a motion: scale, then rotations, then translation, each by the
/// product rule.
fn segment_maxima(inner: PointMaxima, segment: &Segment, from: f64, to: f64) -> PointMaxima {
    let [from, to] = [from, to].map(|time| segment.since(time));
    let largest = |scale: DVec3| scale.abs().max_element();
    let scale = segment.scale.maxima(from, to, largest);
    let scaled = PointMaxima {
        distance: scale.value * inner.distance,
        speed: scale.slope * inner.distance + scale.value * inner.speed,
        acceleration: scale.bend * inner.distance
            + 2.0 * scale.slope * inner.speed
            + scale.value * inner.acceleration,
    };
    let turned = segment.turns().fold(scaled, |inner, turn| {
        let turn = turn.angle.maxima(from, to, f64::abs);
        PointMaxima {
            distance: inner.distance,
            speed: turn.slope * inner.distance + inner.speed,
            acceleration: (turn.slope * turn.slope + turn.bend) * inner.distance
                + 2.0 * turn.slope * inner.speed
                + inner.acceleration,
        }
    });
    let offset = segment.translation.maxima(from, to, DVec3::length);
    PointMaxima {
        distance: turned.distance + offset.value,
        speed: turned.speed + offset.slope,
        acceleration: turned.acceleration + offset.bend,
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use glam::{DQuat, Vec3};
    use scene::{Chance, Interpolation, Key, Object, Parent, Shape, Turn};

    use super::*;
    use crate::test_scene::load_test_scene;

    fn random_vector(chance: &mut Chance) -> DVec3 {
        DVec3::from([(); 3].map(|()| chance.between(-1.0..=1.0)))
    }

    /// Keys at -0.7, 0 and 0.4 with turns of up to `turn` radians, drifts and growth.
    fn random_motion(chance: &mut Chance, interpolation: Interpolation, turn: f64) -> Motion {
        let mut orientation = DQuat::from_axis_angle(random_vector(chance).normalize(), 1.0);
        let keys = [-0.7, 0.0, 0.4].map(|time| {
            let turn = Turn {
                axis: random_vector(chance).normalize(),
                angle: turn * chance.between(-1.0..=1.0),
            };
            let key = Key {
                time,
                translation: 3.0 * random_vector(chance),
                orientation,
                scale: DVec3::ONE + 0.5 * random_vector(chance),
                turn,
            };
            orientation = DQuat::from_axis_angle(turn.axis, turn.angle) * orientation;
            key
        });
        Motion {
            keys: keys.to_vec(),
            interpolation,
        }
    }

    /// Makes a scene of an object, its child and one that the camera carries, all of one mesh.
    fn random_scene(
        chance: &mut Chance,
        interpolation: Interpolation,
        turn: f64,
        shape_times: &[f64],
    ) -> Scene {
        let mut corners = || (0..8).map(|_| random_vector(chance).as_vec3()).collect();
        let positions: Vec<Vec3> = corners();
        let shapes = shape_times.iter().map(|&time| Shape {
            time,
            positions: corners(),
            normals: Vec::new(),
        });
        let shapes = shapes.collect();
        let mut scene = load_test_scene("two_spheres");
        scene.meshes = vec![Mesh {
            positions,
            shapes,
            ..Mesh::default()
        }];
        scene.camera.motion = random_motion(chance, interpolation, turn);
        let parents = [Parent::World, Parent::Object(0), Parent::Camera];
        scene.objects = (parents.into_iter())
            .map(|parent| Object {
                name: "thing".into(),
                mesh: 0,
                materials: Vec::new(),
                motion: random_motion(chance, interpolation, turn),
                parent,
            })
            .collect();
        scene
    }

    fn assert_box_contains_mesh(scene: &Scene, object: usize, [from, to]: [f64; 2]) {
        // Rounding only.
        let aabb = swept_aabb(scene, &Extent::of_meshes(scene), object, from, to).grown(1e-12);
        for step in 0..=1000 {
            let time = from + (to - from) * f64::from(step) / 1000.0;
            let pose = scene.object_to_world(object, time);
            for position in scene.meshes[0].at(time).positions() {
                let point = pose.transform_point3(position);
                let inside = point.cmpge(aabb.min).all() && point.cmple(aabb.max).all();
                assert!(inside, "object {object} leaves {aabb:?} at {time}");
            }
        }
    }

    #[test]
    fn a_swept_box_contains_the_mesh_at_every_time() {
        let mut chance = Chance::new(1, "poses");
        for interpolation in [Interpolation::Linear, Interpolation::Cubic].repeat(4) {
            // No turn, a little, nearly half a turn, and several turns.
            for turn in [0.0, 0.3, 179.0_f64.to_radians(), 6.0 * PI] {
                for shape_times in [&[][..], &[-0.5, 0.0, 0.2]] {
                    let scene = random_scene(&mut chance, interpolation, turn, shape_times);
                    for object in 0..scene.objects.len() {
                        // The interval contains a key and ends beyond the last.
                        assert_box_contains_mesh(&scene, object, [-0.1, 0.0]);
                        assert_box_contains_mesh(&scene, object, [-0.3, 0.6]);
                    }
                }
            }
        }
    }

    #[test]
    fn the_box_of_a_translation_is_tight() {
        let scene = load_test_scene("sliding_panel");
        let extents = Extent::of_meshes(&scene);
        let mut moved = 0;
        for object in 0..scene.objects.len() {
            let swept = |from, to| swept_aabb(&scene, &extents, object, from, to);
            let [first, last] = [-0.1, 0.0].map(|time| swept(time, time));
            assert_eq!(swept(-0.1, 0.0), first.union(last));
            moved += usize::from(first != last);
        }
        assert_eq!(moved, 1);
    }
}
