//! Hundreds of moving objects that share one mesh.

use glam::{DQuat, DVec3};
use tests::random::hash;
use tests::shapes::*;
use tracer::{Interpolation, Key, Motion, Object, Parent, Ray, Scene, Stage, Turn};

/// In [-1, 1), from a counter.
fn number(counter: &mut u64) -> f64 {
    *counter += 1;
    (hash(*counter) >> 11) as f64 / 2f64.powi(52) - 1.0
}

fn vector(counter: &mut u64) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|_| number(counter)))
}

/// So many objects of one mesh, each on a way of its own; every third follows another.
fn swarm(count: usize) -> Scene {
    let mut counter = 8 << 32;
    let mut scene = empty_scene("swarm");
    for index in 0..count {
        let mut orientation = DQuat::IDENTITY;
        let keys = [-1.0, -0.4, 0.3].map(|time| {
            let turn = Turn {
                axis: vector(&mut counter).normalize(),
                angle: 2.0 * number(&mut counter),
            };
            let key = Key {
                time,
                translation: 10.0 * vector(&mut counter),
                orientation,
                scale: DVec3::ONE + 0.5 * vector(&mut counter),
                turn,
            };
            orientation = DQuat::from_axis_angle(turn.axis, turn.angle) * orientation;
            key
        });
        let interpolation = match index % 2 {
            0 => Interpolation::Linear,
            _ => Interpolation::Cubic,
        };
        let motion = Motion {
            keys: keys.to_vec(),
            interpolation,
        };
        if index == 0 {
            add(&mut scene, icosphere(1.0, 2), glowing(1.0), motion);
            continue;
        }
        let parent = match index % 3 {
            2 => Parent::Object(index - 1),
            _ => Parent::World,
        };
        scene.objects.push(Object {
            name: format!("object{index}"),
            mesh: 0,
            materials: vec![0],
            motion,
            parent,
        });
    }
    scene
}

#[test]
fn four_hundred_objects_of_one_mesh_are_met_as_every_triangle_in_turn_says() {
    let scene = swarm(400);
    let [open, close] = [-0.9, 0.5];
    let stage = Stage::new(&scene, open, close);
    let portable = Stage::new(&scene, open, close).portable();
    let mut poses = stage.poses();
    let mut counter = 9 << 32;
    let mut hits = 0;
    for index in 0..600 {
        // Ends, borders of slices, and any time.
        let time = match index % 4 {
            0 => open + (close - open) * f64::from(index / 4 % 17) / 16.0,
            _ => open + (close - open) * 0.5 * (1.0 + number(&mut counter)),
        };
        let origin = if index % 2 == 0 { 12.0 } else { 300.0 } * vector(&mut counter);
        let direction = (10.0 * vector(&mut counter) - origin).normalize();
        let ray = Ray { origin, direction };
        let found = stage.closest(poses.at(time), &ray);
        let expected = stage.closest_of_all(&mut poses, &ray);
        assert_eq!(found, expected, "time {time}, {ray:?}");
        assert_eq!(portable.closest(&mut poses, &ray), expected);
        if let Some(hit) = expected {
            hits += 1;
            assert!(stage.blocked(&mut poses, &ray, hit.t * (1.0 + 1e-9)));
            assert!(!stage.blocked(&mut poses, &ray, hit.t));
        }
    }
    assert!(
        hits > 300,
        "only {hits} rays hit anything: the test shows little"
    );
}
