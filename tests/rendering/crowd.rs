//! A crowd of meshes of every kind in every motion, against brute force.

use glam::{DQuat, DVec3, Vec3};
use tests::brute_force::expect_what_every_triangle_gives;
use tests::random::Numbers;
use tests::shapes::*;
use tracer::{Key, Motion, Scene, Turn};

/// Makes meshes of every kind in every motion; `scale` multiplies all sizes and distances.
fn crowd(scale: f64) -> Scene {
    let mut numbers = Numbers(6 << 32);
    let mut scene = empty_scene("crowd");
    let size = scale as f32;
    let meshes = [
        icosphere(size, 2),
        cuboid(Vec3::new(size, 0.1 * size, 2.0 * size)),
        disc(size, 40),
        rectangle(size, 3.0 * size),
    ];
    for index in 0..12 {
        let turn = Turn {
            axis: numbers.vector().normalize(),
            angle: 4.0 * numbers.next(),
        };
        let key = Key {
            time: -1.0,
            translation: 3.0 * scale * numbers.vector(),
            scale: DVec3::splat(1.0) + 0.5 * numbers.vector(),
            turn,
            ..Key::REST
        };
        let end = Key {
            time: 0.5,
            translation: key.translation + 2.0 * scale * numbers.vector(),
            orientation: DQuat::from_axis_angle(turn.axis, turn.angle),
            turn: Turn::NONE,
            ..key
        };
        let motion = Motion {
            keys: vec![key, end],
            ..Motion::default()
        };
        add(
            &mut scene,
            meshes[index % meshes.len()].clone(),
            glowing(1.0),
            motion,
        );
    }
    scene
}

#[test]
fn the_trees_agree_with_brute_force() {
    for scale in [1e-4, 1e-2, 1.0, 1e3] {
        let scene = crowd(scale);
        expect_what_every_triangle_gives(&scene, [-0.8, 0.7], 3.0 * scale, 4000);
    }
}
