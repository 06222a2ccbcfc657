//! Rays against triangles: no holes, no leaks and no misses at any scale.

use frame::Alignment;
use glam::{DQuat, DVec3, Vec3};
use rayon::prelude::*;
use tests::random::{Numbers, hash};
use tests::shapes::*;
use tests::unwatched;
use tracer::{
    Background, Key, Mesh, Motion, Ray, RenderSettings, Stage, Sun, trace_frame, trace_truth,
};

fn reverse_faces(mut mesh: Mesh) -> Mesh {
    for triangle in &mut mesh.triangles {
        triangle.swap(1, 2);
    }
    mesh
}

#[test]
fn a_square_panel_has_no_hole_at_any_pixel_centre() {
    for size in [16, 64, 90] {
        for panel in [rectangle(1.0, 1.0), reverse_faces(rectangle(1.0, 1.0))] {
            // Fills the picture exactly at a field of view of 90 degrees: the diagonal passes through pixel centres.
            let mut scene = empty_scene("panel");
            let at = placed(DVec3::new(0.0, 0.0, -0.5));
            add(&mut scene, panel, glowing(1.0), at);
            let settings = RenderSettings {
                width: size,
                height: size,
                samples_per_pixel: 1,
                ..RenderSettings::default()
            };
            let frame = trace_frame(&scene, &settings, &unwatched).expect("settings are allowed");
            assert!(frame.object_id.pixels.iter().all(|id| *id == 1));
            assert!(
                frame.coverage[1]
                    .pixels
                    .iter()
                    .all(|coverage| *coverage == 1.0)
            );
        }
    }
}

#[test]
fn parallel_rays_find_no_hole_along_a_diagonal() {
    for panel in [rectangle(1.0, 1.0), reverse_faces(rectangle(1.0, 1.0))] {
        let mut scene = empty_scene("panel");
        add(&mut scene, panel, glowing(1.0), placed(DVec3::ZERO));
        let stage = Stage::new(&scene, 0.0, 0.0);
        let mut poses = stage.poses();
        for step in 0..64 {
            let at = (f64::from(step) + 0.5) / 64.0 - 0.5;
            for across in [at, -at] {
                let ray = Ray {
                    origin: DVec3::new(at, across, 5.0),
                    direction: DVec3::NEG_Z,
                };
                let hit = stage.closest(&mut poses, &ray).expect("no hole");
                assert_eq!(hit.t, 5.0);
            }
        }
    }
}

#[test]
fn a_closed_sphere_does_not_leak_at_its_edges_and_vertices() {
    let mesh = icosphere(1.0, 3);
    let mut scene = empty_scene("sphere");
    // Turned, moved and scaled, so that nothing is exact in the world.
    let motion = Motion::still(Key {
        translation: DVec3::new(3.0, -70.0, 11.0),
        orientation: DQuat::from_axis_angle(DVec3::new(0.36, 0.48, 0.8), 1.0),
        scale: DVec3::new(2.0, 0.5, 1.0),
        ..Key::REST
    });
    add(&mut scene, mesh.clone(), glowing(1.0), motion.clone());
    let pose = motion.at(0.0);
    let stage = Stage::new(&scene, 0.0, 0.0);
    let mut poses = stage.poses();
    let mut numbers = Numbers(3 << 32);
    // Several rays at each edge and vertex: rounding turns only few of them away where it may.
    for triangle in mesh
        .triangles
        .iter()
        .cycle()
        .take(20 * mesh.triangles.len())
    {
        let [a, b, c] = triangle.map(|index| mesh.positions[index as usize].as_dvec3());
        for target in [a, b, c, 0.5 * (a + b), 0.3 * b + 0.7 * c, 0.9 * c + 0.1 * a] {
            // From inside, and from far outside, where the near side must stop the ray.
            for (start, most) in [(0.4, 1.01), (1000.0, 1.0 + 1e-9)] {
                let inner = start * numbers.vector().normalize();
                // Edge-on triangles belong to the silhouette, which rounding may miss.
                if start > 1.0 && inner.normalize().dot(target.normalize()) < 0.2 {
                    continue;
                }
                let origin = pose.transform_point3(inner);
                let direction = pose.transform_point3(target) - origin;
                let ray = Ray { origin, direction };
                let hit = stage.closest(&mut poses, &ray).expect("no leak");
                assert!(hit.t < most, "hit at {}", hit.t);
                assert!(stage.is_blocked(&mut poses, &ray, 1.01));
            }
        }
    }
}

/// Number of rays at exact edges and vertices, half of them from inside.
const AIMED_RAYS: u64 = 10_000_000;

#[test]
fn ten_million_rays_at_edges_and_vertices_do_not_leak() {
    let mesh = icosphere(1.0, 7);
    assert!(mesh.triangles.len() >= 100_000);
    let mut scene = empty_scene("sphere");
    add(
        &mut scene,
        mesh.clone(),
        glowing(1.0),
        Motion::still(Key::REST),
    );
    let stages = [
        Stage::new(&scene, 0.0, 0.0),
        Stage::new(&scene, 0.0, 0.0).portable(),
    ];
    const CHUNK: u64 = 100_000;
    (0..AIMED_RAYS / CHUNK).into_par_iter().for_each(|chunk| {
        let mut numbers = Numbers((9 << 32) + chunk * CHUNK * 8);
        let mut poses = stages[0].poses();
        for index in chunk * CHUNK..(chunk + 1) * CHUNK {
            let triangle = mesh.triangles[(hash(index) % mesh.triangles.len() as u64) as usize];
            let [a, b, _] = triangle.map(|index| mesh.positions[index as usize].as_dvec3());
            let target = match index % 4 {
                0 | 1 => a,
                2 => 0.5 * (a + b),
                _ => a + 0.5 * (1.0 + numbers.next()) * (b - a),
            };
            // From inside, where every way out must be stopped; and from outside towards the near side, which must stop
            // the ray at the target. Edge-on triangles belong to the silhouette, which rounding may miss.
            let inside = index % 2 == 0;
            let origin = if inside {
                0.5 * numbers.vector()
            } else {
                3.0 * (target + 0.2 * numbers.vector())
            };
            let direction = target - origin;
            let ray = Ray { origin, direction };
            // Every search method; the mesh is within 1e-4 of a sphere.
            for stage in &stages {
                let hit = stage.closest(&mut poses, &ray).expect("no leak");
                assert!(hit.t < 1.0 + 1e-9, "ray {index}: hit at {}", hit.t);
                assert!(
                    stage.is_blocked(&mut poses, &ray, 1.0 + 1e-9),
                    "ray {index}"
                );
            }
        }
    });
}

#[test]
fn a_convex_surface_never_meets_its_own_rays_from_1_mm_to_10_km() {
    for (radius, offset) in [
        (1e-3, 0.0),
        (1e-3, 1.0),
        (1.0, 0.0),
        (1.0, 1e4),
        (1e4, 0.0),
        (1e4, 1e5),
    ] {
        let mut scene = empty_scene("convex");
        scene.background = Background::Constant(Vec3::ONE);
        let ball = icosphere(radius as f32, 3);
        let at = DVec3::new(offset, 0.3 * offset, -0.7 * offset);
        add(&mut scene, ball, diffuse(0.5), placed(at));
        // 90 degrees high, closer than the radius: only the ball is in view.
        scene.camera.motion = placed(at + DVec3::new(0.0, 0.0, 1.1 * radius));
        let settings = RenderSettings {
            width: 24,
            height: 24,
            samples_per_pixel: 64,
            replicates: 2,
            ..RenderSettings::default()
        };
        let truth = trace_truth(&scene, &settings, Alignment::Trailing, &unwatched)
            .expect("settings are allowed");
        for half in &truth.halves {
            for pixel in &half.color.pixels {
                // Every path scatters once and leaves. A path that met the surface again would lose half its light, a
                // part of 1 / 64 of the pixel.
                assert!(
                    pixel.iter().all(|part| (part - 0.5).abs() < 1e-6),
                    "radius {radius} m, {offset} m from the origin: {pixel:?}"
                );
            }
        }
    }
}

/// Makes ridges and pits on a square that faces +Z; the normal of every facet has the cosine 2 / sqrt(6) to +Z.
fn egg_crate(side: f32) -> Mesh {
    const CELLS: u32 = 24;
    let cell = side / CELLS as f32;
    let at = |i: u32, j: u32| {
        let high = if (i + j).is_multiple_of(2) {
            0.0
        } else {
            0.5 * cell
        };
        Vec3::new(
            i as f32 * cell - 0.5 * side,
            j as f32 * cell - 0.5 * side,
            high,
        )
    };
    let row = CELLS + 1;
    let positions = (0..row * row)
        .map(|index| at(index % row, index / row))
        .collect();
    let mut triangles = Vec::new();
    for (i, j) in (0..CELLS * CELLS).map(|index| (index % CELLS, index / CELLS)) {
        let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(x, y)| (j + y) * row + i + x);
        // Split between the high corners.
        if (i + j).is_multiple_of(2) {
            triangles.extend([[a, b, d], [b, c, d]]);
        } else {
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh(positions, triangles)
}

#[test]
fn pits_are_lit_to_their_bottom_from_1_mm_to_10_km() {
    for (side, offset) in [(1e-3, 0.0), (1e-3, 1.0), (1.0, 1e4), (1e4, 0.0), (1e4, 1e5)] {
        let mut scene = empty_scene("pits");
        // So dark that light from facet to facet is lost in rounding.
        let albedo = 1e-7;
        let at = DVec3::new(offset, 0.3 * offset, -0.7 * offset);
        add(
            &mut scene,
            egg_crate(side as f32),
            diffuse(albedo),
            placed(at),
        );
        // 90 degrees high: the picture's corners see the field's corners.
        scene.camera.motion = placed(at + DVec3::new(0.0, 0.0, 0.45 * side));
        scene.sun = Some(Sun {
            direction: DVec3::Z,
            irradiance: Vec3::ONE,
            angular_radius: 0.0,
        });
        let settings = RenderSettings {
            width: 24,
            height: 24,
            samples_per_pixel: 64,
            replicates: 2,
            ..RenderSettings::default()
        };
        let truth = trace_truth(&scene, &settings, Alignment::Trailing, &unwatched)
            .expect("settings are allowed");
        let expected = f64::from(albedo) / std::f64::consts::PI * 2.0 / 6.0f64.sqrt();
        for half in &truth.halves {
            for pixel in &half.color.pixels {
                // From straight above nothing shades anything; a facet that shaded itself once would lose 1 / 32.
                let part = f64::from(pixel[0]) / expected;
                assert!(
                    (part - 1.0).abs() < 1e-3,
                    "side {side} m, {offset} m off: {part}"
                );
            }
        }
    }
}

#[test]
fn the_nearest_of_three_overlapping_objects_wins_in_every_order() {
    let panels = [(1.0, 3.0), (2.0, 4.0), (3.0, 5.0)];
    for order in [
        [0, 1, 2],
        [0, 2, 1],
        [1, 0, 2],
        [1, 2, 0],
        [2, 0, 1],
        [2, 1, 0],
    ] {
        let mut scene = empty_scene("overlap");
        for index in order {
            let (depth, size): (f64, f32) = panels[index];
            // Boxes that contain one another's fronts.
            add(&mut scene, cuboid(Vec3::splat(size)), glowing(1.0), {
                placed(DVec3::new(0.0, 0.0, -depth - 0.5 * f64::from(size)))
            });
        }
        let stage = Stage::new(&scene, 0.0, 0.0);
        let mut numbers = Numbers(4 << 32);
        for _ in 0..100 {
            let direction = DVec3::new(0.3 * numbers.next(), 0.3 * numbers.next(), -1.0);
            let origin = DVec3::ZERO;
            let hit = stage
                .closest(&mut stage.poses(), &Ray { origin, direction })
                .expect("the boxes fill the view");
            assert_eq!(order[hit.object], 0);
            assert!((hit.t - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn the_first_of_equally_near_surfaces_is_seen() {
    let coincident = |mirror: [f64; 2]| {
        let mut scene = empty_scene("ties");
        for z in mirror {
            // A panel at z = 0 and a wing beside it, which makes the trees visit the object with the nearer wing first.
            let mut panel = rectangle(2.0, 2.0);
            let wing = [3.0, 3.5, 4.0].map(|x| Vec3::new(x, x * x, 8.0));
            panel.positions.extend(wing);
            panel.triangles.push([4, 5, 6]);
            panel.slots.push(0);
            let pose = Key {
                scale: DVec3::new(1.0, 1.0, z),
                ..Key::REST
            };
            add(&mut scene, panel, glowing(1.0), Motion::still(pose));
        }
        scene
    };
    for mirror in [[1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]] {
        let scene = coincident(mirror);
        let stage = Stage::new(&scene, 0.0, 0.0);
        for (x, y) in [(0.0, 0.0), (0.5, 0.5), (-0.5, 0.25), (1.0, 1.0)] {
            let ray = Ray {
                origin: DVec3::new(x, y, 2.0),
                direction: DVec3::NEG_Z,
            };
            let hit = stage.closest(&mut stage.poses(), &ray).expect("aimed at");
            assert_eq!((hit.object, hit.t), (0, 2.0));
        }
        // A ray on the diagonal meets both triangles, and the first one is seen.
        let ray = Ray {
            origin: DVec3::new(0.5, 0.5, 2.0),
            direction: DVec3::NEG_Z,
        };
        let hit = stage.closest(&mut stage.poses(), &ray).expect("aimed at");
        assert_eq!(hit.triangle, 0);
    }
}
