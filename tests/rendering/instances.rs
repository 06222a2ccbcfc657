//! Hundreds of objects that share one mesh, moving and standing still.

use glam::{DQuat, DVec3};
use tests::brute_force::expect_what_every_triangle_gives;
use tests::random::Numbers;
use tests::shapes::*;
use tracer::{Interpolation, Key, Motion, Object, Parent, Scene, Turn};

/// Makes a scene of `count` objects of one mesh, each with its own motion; every third has another as its parent.
fn swarm(count: usize) -> Scene {
    let mut numbers = Numbers(8 << 32);
    let mut scene = empty_scene("swarm");
    for index in 0..count {
        let mut orientation = DQuat::IDENTITY;
        let keys = [-1.0, -0.4, 0.3].map(|time| {
            let turn = Turn {
                axis: numbers.vector().normalize(),
                angle: 2.0 * numbers.next(),
            };
            let key = Key {
                time,
                translation: 10.0 * numbers.vector(),
                orientation,
                scale: DVec3::ONE + 0.5 * numbers.vector(),
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
fn rays_at_four_hundred_objects_of_one_mesh_agree_with_brute_force() {
    let scene = swarm(400);
    expect_what_every_triangle_gives(&scene, [-0.9, 0.5], 10.0, 600);
}

#[test]
fn rays_at_still_objects_among_moving_ones_agree_with_brute_force() {
    let mut scene = swarm(60);
    for (index, object) in scene.objects.iter_mut().enumerate() {
        // Some still objects have moving parents, and some moving objects have still ones.
        if index % 5 < 3 {
            object.motion.keys.truncate(1);
        }
        // Half of the moving objects keep their size.
        if index % 2 == 0 {
            let scale = object.motion.keys[0].scale;
            (object.motion.keys.iter_mut()).for_each(|key| key.scale = scale);
        }
    }
    // An object of the same mesh whose texture is one hole.
    let mut hole = glowing(1.0);
    hole.opacity = 0.0;
    scene.materials.push(hole);
    for index in [1, 12, 13] {
        scene.objects[index].materials = vec![1];
    }
    expect_what_every_triangle_gives(&scene, [-0.9, 0.5], 8.0, 3000);
    // At one time, all objects stand still.
    expect_what_every_triangle_gives(&scene, [-0.4, -0.4], 8.0, 1000);
}
