//! Deforming meshes, against rigid ones, closed forms and brute force.

use frame::{Alignment, Shutter, VelocityKind};
use glam::{DQuat, DVec2, DVec3, Vec3};
use scene::{Key, Mesh, Motion, Scene, Shape};
use tests::brute_force::expect_what_every_triangle_gives;
use tests::half_plane::half_plane;
use tests::random::Numbers;

use crate::intersection::expect_no_leak;
use crate::moving_shapes::{DISTANCE, HEIGHT, WIDTH, expect_coverage, pixel_corner};
use crate::renders::*;

/// Makes a mesh with key shapes: `place` moves each vertex.
pub fn deforming_mesh(mesh: Mesh, times: &[f64], place: impl Fn(Vec3, f64) -> Vec3) -> Mesh {
    let shape = |&time: &f64| Shape {
        time,
        positions: mesh.positions.iter().map(|p| place(*p, time)).collect(),
        normals: mesh.normals.clone(),
    };
    let shapes: Vec<Shape> = times.iter().map(shape).collect();
    let positions = shapes[0].positions.clone();
    Mesh {
        positions,
        shapes,
        ..mesh
    }
}

fn render_velocities(scene: &Scene, velocity: VelocityKind) -> Vec<[f32; 2]> {
    let settings = settings_with([WIDTH, HEIGHT], 1, velocity);
    render_frame(scene, &settings).velocity.pixels
}

/// Makes a scene of one glowing mesh at the distance where a metre is a pixel.
fn scene_of(mesh: Mesh, motion: impl Fn(DVec3) -> Motion) -> Scene {
    let mut scene = empty_scene("deforming");
    let at = DVec3::new(0.0, 0.0, -DISTANCE);
    add(&mut scene, mesh, glowing(1.0), motion(at));
    scene.exposure = 0.75;
    scene
}

#[test]
fn shifting_shapes_equal_a_translation() {
    let velocity = DVec3::new(14.0, 3.0, 0.0);
    let panel = rectangle(6.0, 40.0);
    // Times go beyond the last shape.
    let shifted = deforming_mesh(panel.clone(), &[-1.0, -0.25, 0.0], |place, time| {
        place + (time * velocity).as_vec3()
    });
    let rigid = scene_of(panel, |at| drift(at, velocity));
    let scene = scene_of(shifted, placed);
    for alignment in [Alignment::Trailing, Alignment::Leading] {
        expect_coverage("shifted", &scene, alignment, |pixel, shutter| {
            let edge = |offset| half_plane(pixel, DVec2::X, offset, velocity.x, shutter);
            edge(3.0) - edge(-3.0)
        });
    }
    for kind in VelocityKind::ALL {
        let [actual, expected] = [&scene, &rigid].map(|scene| render_velocities(scene, kind));
        let pairs = actual.as_flattened().iter().zip(expected.as_flattened());
        for (actual, expected) in pairs {
            // The step of the difference quotient leaves 1e-6 pixels of rounding.
            assert!((actual - expected).abs() < 1e-4);
        }
    }
}

#[test]
fn a_stretching_panel_covers_and_moves_as_its_edges_do() {
    // The left edge stays; the right one moves, and reverses at a key inside the shutter.
    let panel = rectangle(10.0, 400.0);
    let right = |time: f64| {
        if time < -0.2 {
            5.0 + 10.0 * time
        } else {
            3.0 - 5.0 * (time + 0.2)
        }
    };
    let stretched = deforming_mesh(panel, &[-1.0, -0.2, 0.5], |place, time| {
        if place.x > 0.0 {
            Vec3::new(right(time) as f32, place.y, 0.0)
        } else {
            place
        }
    });
    let scene = scene_of(stretched, placed);
    let covered = |pixel: DVec2, shutter: Shutter| {
        let part = |open: f64, close: f64, offset, speed| {
            let part = Shutter::new(open, close).expect("not empty");
            let weight = part.exposure() / shutter.exposure();
            weight * half_plane(pixel, DVec2::X, offset, speed, part)
        };
        let edge = part(shutter.open, -0.2, 5.0, 10.0) + part(-0.2, shutter.close, 2.0, -5.0);
        edge - half_plane(pixel, DVec2::X, -5.0, 0.0, shutter)
    };
    expect_coverage("stretched", &scene, Alignment::Trailing, covered);
    // At t = 0 the panel reaches from -5 to 2, and its points stretch in proportion.
    let velocities = render_velocities(&scene, VelocityKind::Instantaneous);
    for (pixel, [across, down]) in velocities.into_iter().enumerate() {
        let x = pixel_corner(pixel as u32 % WIDTH, 0).x + 0.5;
        let expected = if (-5.0..2.0).contains(&x) {
            -5.0 * (x + 5.0) / 7.0
        } else {
            0.0
        };
        // Vertices are rounded to f32.
        assert!((f64::from(across) - expected).abs() < 1e-4 && down.abs() < 1e-4);
    }
}

/// Makes a sphere that turns into a potato and back into an egg.
fn potato() -> Mesh {
    let mut numbers = Numbers(5 << 32);
    let waves: Vec<DVec3> = (0..4).map(|_| 3.0 * numbers.vector()).collect();
    deforming_mesh(icosphere(1.0, 3), &[-0.7, -0.1, 0.3], |place, time| {
        let place = place.as_dvec3();
        let bump: f64 = waves.iter().map(|wave| wave.dot(place).sin()).sum();
        let stretched = DVec3::new(1.0 + 0.5 * time, 1.0, 1.0 - 0.5 * time) * place;
        ((1.0 + 0.03 * bump * (1.0 - time)) * stretched).as_vec3()
    })
}

/// Makes a pose that is exact in no coordinate: moved, turned and scaled.
fn skewed(at: DVec3) -> Motion {
    let mut motion = spin(at, DVec3::new(0.36, 0.48, 0.8), 1.7);
    for key in &mut motion.keys {
        key.scale = DVec3::new(2.0, 0.5, 1.0);
    }
    motion
}

/// The positions of vertices are right to a thousand-millionth, and rays stop there.
#[test]
fn a_deforming_sphere_does_not_leak_at_its_edges_and_vertices() {
    let mesh = potato();
    let shapes = mesh.shapes.clone();
    let position = |vertex: u32, time: f64| {
        let next = if time < -0.1 { 1 } else { 2 };
        let [from, to] = [&shapes[next - 1], &shapes[next]];
        let fraction = (time - from.time) / (to.time - from.time);
        let [start, end] = [from, to].map(|shape| shape.positions[vertex as usize].as_dvec3());
        start + fraction * (end - start)
    };
    let mut scene = empty_scene("potato");
    let motion = skewed(DVec3::new(3.0, -70.0, 11.0));
    add(&mut scene, mesh, glowing(1.0), motion);
    expect_no_leak(&scene, [-0.9, 0.4], 80_000, position);
}

#[test]
fn the_trees_agree_with_brute_force() {
    let mut scene = empty_scene("potatoes");
    let large = skewed(DVec3::X);
    add(&mut scene, potato(), glowing(1.0), large);
    let half = |(time, place)| Key {
        scale: DVec3::splat(0.5),
        orientation: DQuat::from_rotation_x(1.0),
        ..key(time, place)
    };
    let small = through([(0.0, DVec3::NEG_X), (1.0, DVec3::Y)].map(half));
    add(&mut scene, icosphere(1.0, 1), glowing(1.0), small);
    scene.objects[1].mesh = 0;
    expect_what_every_triangle_gives(&scene, [-0.9, 0.6], 1.5, 2000);
}
