//! Rays against trees of many meshes and objects in every motion, compared with brute force.

use glam::Vec3;
use scene::{Interpolation, Object, Parent, Scene};
use tests::brute_force::expect_what_every_triangle_gives;
use tests::random::Numbers;
use tests::shapes::*;

use crate::motion::random_motion;

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
    for mesh in meshes.iter().cycle().take(12) {
        let far = [3.0 * scale, 4.0];
        let motion = random_motion(&mut numbers, Interpolation::Linear, &[-1.0, 0.5], far);
        add(&mut scene, mesh.clone(), glowing(1.0), motion);
    }
    scene
}

#[test]
fn a_crowd_of_every_size_is_met_as_by_brute_force() {
    for scale in [1e-4, 1e-2, 1.0, 1e3] {
        expect_what_every_triangle_gives(&crowd(scale), [-0.8, 0.7], 3.0 * scale, 4000);
    }
}

/// Makes a scene of `count` objects of one mesh, each with its own motion; every third has another
/// as its parent.
fn swarm(count: usize) -> Scene {
    let mut numbers = Numbers(8 << 32);
    let mut scene = empty_scene("swarm");
    scene.meshes.push(icosphere(1.0, 2));
    scene.materials.push(glowing(1.0));
    for index in 0..count {
        let interpolation = match index % 2 {
            0 => Interpolation::Linear,
            _ => Interpolation::Cubic,
        };
        let times = [-1.0, -0.4, 0.3];
        scene.objects.push(Object {
            name: format!("object{index}"),
            mesh: 0,
            materials: vec![0],
            motion: random_motion(&mut numbers, interpolation, &times, [10.0, 2.0]),
            parent: match index % 3 {
                2 => Parent::Object(index - 1),
                _ => Parent::World,
            },
        });
    }
    scene
}

#[test]
fn four_hundred_objects_of_one_mesh_are_met_as_by_brute_force() {
    expect_what_every_triangle_gives(&swarm(400), [-0.9, 0.5], 10.0, 600);
}

#[test]
fn still_objects_among_moving_ones_are_met_as_by_brute_force() {
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
    // An object of the same mesh with a texture that is one hole.
    let mut hole = glowing(1.0);
    hole.opacity = 0.0;
    scene.materials.push(hole);
    for index in [1, 12, 13] {
        scene.objects[index].materials = vec![1];
    }
    expect_what_every_triangle_gives(&scene, [-0.9, 0.5], 8.0, 3000);
    // At one time, all objects are still.
    expect_what_every_triangle_gives(&scene, [-0.4, -0.4], 8.0, 1000);
}
