//! Deforming meshes, against rigid ones, closed forms and brute force.

use frame::{Alignment, FrameOptions, Truth, VelocityKind};
use glam::{DQuat, DVec2, DVec3, Vec3};
use tests::brute_force::expect_what_every_triangle_gives;
use tests::half_plane::half_plane;
use tests::random::Numbers;
use tests::shapes::*;
use tests::unwatched;
use tracer::{Key, Mesh, Motion, Ray, RenderSettings, Scene, Shape, Stage, trace_frame};

use crate::moving_shapes::{DISTANCE, HEIGHT, WIDTH, expect_coverage, pixel_corner, render_truth};

/// Makes a mesh with key shapes: `place` moves each vertex.
fn deforming_mesh(mesh: Mesh, times: &[f64], place: impl Fn(Vec3, f64) -> Vec3) -> Mesh {
    let shapes: Vec<Shape> = times
        .iter()
        .map(|&time| Shape {
            time,
            positions: mesh.positions.iter().map(|p| place(*p, time)).collect(),
            normals: mesh.normals.clone(),
        })
        .collect();
    Mesh {
        positions: shapes[0].positions.clone(),
        shapes,
        ..mesh
    }
}

fn render_velocities(scene: &Scene, velocity: VelocityKind) -> Vec<[f32; 2]> {
    let settings = RenderSettings {
        width: WIDTH,
        height: HEIGHT,
        options: FrameOptions {
            velocity,
            ..FrameOptions::default()
        },
        samples_per_pixel: 1,
        ..RenderSettings::default()
    };
    let frame = trace_frame(scene, &settings, &unwatched).expect("settings are allowed");
    frame.velocity.pixels
}

/// Compares the coverage of the only object, and checks that nothing else moves.
fn expect_object(what: &str, truth: &Truth, exact: impl Fn(DVec2) -> f64) {
    expect_coverage(what, truth, |x, y| exact(pixel_corner(x, y)));
    assert_eq!(
        truth.motion,
        truth.mean().coverage[1],
        "only the object moves"
    );
}

/// Makes a scene of one glowing mesh at the distance where metres are pixels.
fn scene_of(mesh: Mesh, motion: impl Fn(DVec3) -> Motion) -> Scene {
    let mut scene = empty_scene("deforming");
    let at = DVec3::new(0.0, 0.0, -DISTANCE);
    add(&mut scene, mesh, glowing(1.0), motion(at));
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
    for alignment in Alignment::ALL {
        let truth = render_truth(&scene, alignment);
        expect_object(&format!("shifted, {alignment}"), &truth, |pixel| {
            let edge = |offset| half_plane(pixel, DVec2::X, offset, velocity.x, truth.shutter);
            edge(3.0) - edge(-3.0)
        });
    }
    for kind in VelocityKind::ALL {
        for (found, expected) in render_velocities(&scene, kind)
            .iter()
            .zip(render_velocities(&rigid, kind))
        {
            // The step of the difference quotient leaves 1e-6 pixels of rounding.
            assert!((0..2).all(|axis| (found[axis] - expected[axis]).abs() < 1e-4));
        }
    }
}

#[test]
fn a_stretching_panel_covers_and_moves_as_its_edges_do() {
    // The left edge stays; the right one moves, and turns back at a key inside the shutter.
    let panel = rectangle(10.0, 400.0);
    let right = |time: f64| match time < -0.2 {
        true => 5.0 + 10.0 * time,
        false => 3.0 - 5.0 * (time + 0.2),
    };
    let stretched = deforming_mesh(panel, &[-1.0, -0.2, 0.5], |place, time| {
        match place.x > 0.0 {
            true => Vec3::new(right(time) as f32, place.y, 0.0),
            false => place,
        }
    });
    let scene = scene_of(stretched, placed);
    let truth = render_truth(&scene, Alignment::Trailing);
    let shutter = truth.shutter;
    expect_object("stretched", &truth, |pixel| {
        let part = |open: f64, close: f64, offset, speed| {
            let part = frame::Shutter::new(open, close).expect("not empty");
            let weight = part.exposure() / shutter.exposure();
            weight * half_plane(pixel, DVec2::X, offset, speed, part)
        };
        let edge = part(shutter.open, -0.2, 5.0, 10.0) + part(-0.2, shutter.close, 2.0, -5.0);
        edge - half_plane(pixel, DVec2::X, -5.0, 0.0, shutter)
    });
    // At t = 0 the panel reaches from -5 to 2, and its points stretch in proportion.
    for (pixel, found) in render_velocities(&scene, VelocityKind::Instantaneous)
        .iter()
        .enumerate()
    {
        let x = pixel_corner(pixel as u32 % WIDTH, 0).x + 0.5;
        let expected = if (-5.0..2.0).contains(&x) {
            -5.0 * (x + 5.0) / 7.0
        } else {
            0.0
        };
        // Vertices are rounded to f32.
        assert!((f64::from(found[0]) - expected).abs() < 1e-4 && found[1].abs() < 1e-4);
    }
}

#[test]
fn a_surface_moves_on_the_line_through_two_shapes() {
    let depth = |time: f64| 3.0 + time;
    let panel = deforming_mesh(rectangle(9.0, 9.0), &[-1.0, 1.0], |place, time| {
        place - (depth(time) * DVec3::Z).as_vec3()
    });
    let mut scene = empty_scene("depth");
    add(&mut scene, panel, glowing(1.0), placed(DVec3::ZERO));
    let stage = Stage::new(&scene, -2.0, 2.0);
    let mut poses = stage.poses();
    let ray = Ray {
        origin: DVec3::new(0.5, 0.25, 0.0),
        direction: DVec3::NEG_Z,
    };
    for time in [-2.0, -1.0, -0.25, 0.0, 0.5, 1.0, 2.0] {
        let hit = stage.closest(poses.at(time), &ray).expect("aimed at");
        // Rounding in 64 bits.
        assert!((hit.t - depth(time)).abs() < 1e-14, "{} at {time}", hit.t);
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

#[test]
fn a_deforming_sphere_does_not_leak_at_its_edges_and_vertices() {
    let mesh = potato();
    let mut scene = empty_scene("potato");
    let motion = skewed(DVec3::new(3.0, -70.0, 11.0));
    add(&mut scene, mesh.clone(), glowing(1.0), motion.clone());
    let stage = Stage::new(&scene, -0.9, 0.4);
    let mut poses = stage.poses();
    let mut numbers = Numbers(6 << 32);
    for triangle in mesh
        .triangles
        .iter()
        .cycle()
        .take(10 * mesh.triangles.len())
    {
        let time = -0.25 + 0.65 * numbers.next();
        let next = mesh
            .shapes
            .partition_point(|shape| shape.time <= time)
            .clamp(1, 2);
        let [from, to] = [&mesh.shapes[next - 1], &mesh.shapes[next]];
        let fraction = (time - from.time) / (to.time - from.time);
        let [a, b, c] = triangle.map(|vertex| {
            let [from, to] = [from, to].map(|shape| shape.positions[vertex as usize].as_dvec3());
            from + fraction * (to - from)
        });
        for target in [a, b, c, 0.5 * (a + b), 0.3 * b + 0.7 * c, 0.9 * c + 0.1 * a] {
            let pose = motion.at(time);
            let origin = pose.transform_point3(0.1 * numbers.vector());
            let direction = pose.transform_point3(target) - origin;
            let ray = Ray { origin, direction };
            let hit = stage.closest(poses.at(time), &ray).expect("no leak");
            assert!(hit.t < 1.01, "hit at {}", hit.t);
            assert!(stage.is_blocked(&mut poses, &ray, 1.01));
        }
    }
}

#[test]
fn the_trees_agree_with_brute_force() {
    let mut scene = empty_scene("potatoes");
    add(
        &mut scene,
        potato(),
        glowing(1.0),
        skewed(DVec3::new(1.0, 0.0, 0.0)),
    );
    let mut small = Motion::still(Key {
        scale: DVec3::splat(0.5),
        orientation: DQuat::from_rotation_x(1.0),
        translation: DVec3::NEG_X,
        ..Key::REST
    });
    small.keys.push(Key {
        time: 1.0,
        translation: DVec3::Y,
        ..small.keys[0]
    });
    add(&mut scene, icosphere(1.0, 1), glowing(1.0), small.clone());
    scene.objects[1].mesh = 0;
    expect_what_every_triangle_gives(&scene, [-0.9, 0.6], 1.5, 2000);
}

#[test]
fn a_growing_lamp_lights_like_a_scaled_one() {
    let grown = |time: f64| 1.0 + 0.5 * time;
    let lamp = rectangle(4.0, 2.0);
    let shapes = deforming_mesh(lamp.clone(), &[-1.0, 1.0], |place, time| {
        grown(time) as f32 * place
    });
    let scaled = |at: DVec3| {
        let key = |time: f64| Key {
            time,
            translation: at,
            scale: DVec3::splat(grown(time)),
            ..Key::REST
        };
        Motion {
            keys: vec![key(-1.0), key(1.0)],
            ..Motion::default()
        }
    };
    let lit = |mesh: Mesh, motion: &dyn Fn(DVec3) -> Motion| {
        let mut scene = empty_scene("lamp");
        add(
            &mut scene,
            rectangle(30.0, 30.0),
            diffuse(0.5),
            placed(DVec3::new(0.0, 0.0, -8.0)),
        );
        add(
            &mut scene,
            mesh,
            glowing(3.0),
            motion(DVec3::new(0.0, 1.0, -5.0)),
        );
        render_truth(&scene, Alignment::Trailing).mean().color
    };
    let [deformed, scaled] = [lit(shapes, &placed), lit(lamp, &scaled)];
    let largest = (deformed.pixels.iter().zip(&scaled.pixels))
        .map(|(a, b)| (a[0] - b[0]).abs())
        .fold(0.0, f32::max);
    // The same random numbers meet the same surfaces. Only a ray that rounding takes past an edge differs, by one of
    // 1024 samples of at most 3.
    assert!(largest < 2.0 * 3.0 / 1024.0, "pixels differ by {largest}");
    let lit = scaled.pixels.iter().filter(|pixel| pixel[0] > 0.02).count();
    assert!(lit > 80, "only {lit} pixels are lit");
}
