//! Rays against triangles: no holes, no leaks and no misses at any scale.

use std::f64::consts::PI;

use frame::Alignment;
use glam::{DQuat, DVec3, Vec3};
use rayon::prelude::*;
use scene::{Background, Key, Mesh, Motion, Scene};
use tests::random::{Numbers, hash};
use tracer::{Ray, Stage};

use crate::renders::*;

#[test]
fn a_square_has_no_hole_along_its_diagonals() {
    let mut reversed = rectangle(1.0, 1.0);
    for triangle in &mut reversed.triangles {
        triangle.swap(1, 2);
    }
    for panel in [rectangle(1.0, 1.0), reversed] {
        let mut scene = empty_scene("panel");
        add(&mut scene, panel, glowing(1.0), placed(DVec3::ZERO));
        let stage = Stage::new(&scene, 0.0, 0.0);
        let mut poses = stage.poses();
        for step in 0..64 {
            let at = (f64::from(step) + 0.5) / 64.0 - 0.5;
            for across in [at, -at] {
                let target = DVec3::new(at, across, 0.0);
                // Parallel rays, and rays from one eye.
                for origin in [target + 5.0 * DVec3::Z, 0.5 * DVec3::Z] {
                    let direction = target - origin;
                    let ray = Ray { origin, direction };
                    let hit = stage.closest(&mut poses, &ray).expect("no hole");
                    assert_eq!(hit.t, 1.0);
                }
            }
        }
    }
}

/// Fails if rays at exact edges and vertices of a scene's only object, which is closed, pass it.
/// `position` gives a vertex at a time.
pub fn expect_no_leak(
    scene: &Scene,
    [open, close]: [f64; 2],
    count: u64,
    position: impl Fn(u32, f64) -> DVec3 + Sync,
) {
    const CHUNK: u64 = 10_000;
    let (mesh, motion) = (&scene.meshes[0], &scene.objects[0].motion);
    let stages = [
        Stage::new(scene, open, close),
        Stage::new(scene, open, close).portable(),
    ];
    (0..count / CHUNK).into_par_iter().for_each(|chunk| {
        let mut numbers = Numbers((9 << 32) + chunk * CHUNK * 8);
        let mut poses = stages[0].poses();
        for index in chunk * CHUNK..(chunk + 1) * CHUNK {
            let time = open + (close - open) * 0.5 * (1.0 + numbers.next());
            let triangle = mesh.triangles[(hash(index) % mesh.triangles.len() as u64) as usize];
            let [a, b, _] = triangle.map(|vertex| position(vertex, time));
            let target = match index % 4 {
                0 | 1 => a,
                2 => 0.5 * (a + b),
                _ => a + 0.5 * (1.0 + numbers.next()) * (b - a),
            };
            // Rays start inside, where every way out must be stopped, and outside towards the near
            // side of a convex mesh, which must stop the ray at the target. Edge-on triangles
            // belong to the silhouette, which rounding may miss.
            let start = match index / 4 % 4 {
                2 if mesh.shapes.is_empty() => 3.0 * (target + 0.2 * numbers.vector()),
                3 if mesh.shapes.is_empty() => 1000.0 * (target + 0.2 * numbers.vector()),
                _ => 0.1 * numbers.vector(),
            };
            let pose = motion.at(time);
            let origin = pose.transform_point3(start);
            let direction = pose.transform_point3(target) - origin;
            let ray = Ray { origin, direction };
            for stage in &stages {
                let hit = stage.closest(poses.at(time), &ray).expect("no leak");
                assert!(hit.t < 1.0 + 1e-9, "ray {index}: hit at {}", hit.t);
                let blocked = stage.is_blocked(poses.at(time), &ray, 1.0 + 1e-9);
                assert!(blocked, "ray {index}");
            }
        }
    });
}

/// Aims rays at a sphere with this many splits.
fn expect_tight_sphere(splits: u32, motion: Motion, count: u64) {
    let mut scene = empty_scene("sphere");
    add(&mut scene, icosphere(1.0, splits), glowing(1.0), motion);
    let positions = &scene.meshes[0].positions;
    let position = |vertex: u32, _| positions[vertex as usize].as_dvec3();
    expect_no_leak(&scene, [0.0; 2], count, position);
}

#[test]
fn rays_at_edges_and_vertices_do_not_leak() {
    expect_tight_sphere(5, Motion::still(Key::REST), 50_000);
    // Turned, moved and scaled, so that nothing is exact in the world.
    let skewed = Motion::still(Key {
        translation: DVec3::new(3.0, -70.0, 11.0),
        orientation: DQuat::from_axis_angle(DVec3::new(0.36, 0.48, 0.8), 1.0),
        scale: DVec3::new(2.0, 0.5, 1.0),
        ..Key::REST
    });
    expect_tight_sphere(3, skewed, 50_000);
}

#[test]
#[ignore = "prove: ten million rays at 327,680 triangles"]
fn ten_million_rays_at_edges_and_vertices_do_not_leak() {
    expect_tight_sphere(7, Motion::still(Key::REST), 10_000_000);
}

/// Renders a mesh at this distance along +Z from a camera that sees 90 degrees, and calls `check`
/// with each colour of each half.
fn for_each_color(mut scene: Scene, at: DVec3, distance: f64, check: impl Fn([f32; 3])) {
    scene.objects[0].motion = placed(at);
    scene.camera.motion = placed(at + distance * DVec3::Z);
    let truth = render_truth(&scene, &settings_of_two([24, 24], 64), Alignment::Trailing);
    let halves = truth.halves.iter();
    halves.for_each(|half| half.color.pixels.iter().copied().for_each(&check));
}

/// Sizes and distances from the world's origin, in metres.
const SCALES: &[[f64; 2]] = &[
    [1e-3, 0.0],
    [1e-3, 1.0],
    [1., 0.],
    [1., 1e4],
    [1e4, 0.],
    [1e4, 1e5],
];

fn place(offset: f64) -> DVec3 {
    DVec3::new(offset, 0.3 * offset, -0.7 * offset)
}

#[test]
fn a_convex_surface_never_meets_its_own_rays_from_1_mm_to_10_km() {
    for [radius, offset] in SCALES.iter().copied() {
        let mut scene = empty_scene("convex");
        scene.background = Background::Constant(Vec3::ONE);
        let ball = icosphere(radius as f32, 3);
        add(&mut scene, ball, diffuse(0.5), placed(DVec3::ZERO));
        // Closer than the radius: only the ball is in view.
        for_each_color(scene, place(offset), 1.1 * radius, |color| {
            // Every path scatters once and leaves. A path that hit the surface again would lose
            // half its light, 1 / 64 of the pixel.
            let is_half = color.iter().all(|part| (part - 0.5).abs() < 1e-6);
            assert!(is_half, "{radius} m, {offset} m from the origin: {color:?}");
        });
    }
}

/// Makes ridges and pits on a square that faces +Z; the normal of every facet has the cosine 2 /
/// sqrt(6) to +Z.
fn egg_crate(side: f32) -> Mesh {
    const CELLS: u32 = 24;
    let cell = side / CELLS as f32;
    let at = |i: u32, j: u32| {
        let [x, y] = [i, j].map(|step| step as f32 * cell - 0.5 * side);
        Vec3::new(x, y, ((i + j) % 2) as f32 * 0.5 * cell)
    };
    let row = CELLS + 1;
    let positions = (0..row * row).map(|index| at(index % row, index / row));
    let positions = positions.collect();
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
    for [side, offset] in SCALES.iter().copied() {
        let mut scene = empty_scene("pits");
        // The facets are so dark that light from one to another is lost in rounding.
        let albedo = 1e-7;
        let pits = egg_crate(side as f32);
        add(&mut scene, pits, diffuse(albedo), placed(DVec3::ZERO));
        scene.sun = sun(DVec3::Z, 1.0, 0.0);
        let expected = f64::from(albedo) / PI * 2.0 / 6.0f64.sqrt();
        // The picture's corners see the field's corners.
        for_each_color(scene, place(offset), 0.45 * side, |color| {
            // Light from straight above leaves no shadows. A facet that shaded itself once would
            // lose 1 / 32.
            let what = format!("side {side} m, {offset} m off");
            expect_near(&what, f64::from(color[0]), expected, 1e-3 * expected);
        });
    }
}

#[test]
fn the_first_of_equally_near_surfaces_is_seen() {
    let coincident = |mirror: [f64; 2]| {
        let mut scene = empty_scene("ties");
        for z in mirror {
            // A panel at z = 0 and a wing next to it, which makes the trees visit the object with
            // the nearer wing first.
            let mut panel = rectangle(2.0, 2.0);
            let wing = [3.0, 3.5, 4.0].map(|x| Vec3::new(x, x * x, 8.0));
            panel.positions.extend(wing);
            panel.triangles.push([4, 5, 6]);
            panel.slots.push(0);
            let mut pose = Key::REST;
            pose.scale = DVec3::new(1.0, 1.0, z);
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
            // A ray on the diagonal hits both triangles, and the first one is visible.
            assert!(x != y || hit.triangle == 0);
        }
    }
}
