//! Films and stacks of films, still and moving.

use std::f64::consts::FRAC_PI_4;

use frame::{Alignment, ColorSampling, Frame};
use glam::{DQuat, DVec2, DVec3, Vec3};
use scene::{Background, Scene};
use tests::half_plane::half_plane;
use tests::random::Random;
use tests::statistics::{estimate_pixels, expect_agreement};

use super::{assert_near, film, glass, hang};
use crate::moving_shapes::{SPEED, half_plane_scene, pixel_corner, truth_settings};
use crate::renders::*;

const SKY: Vec3 = Vec3::new(0.4, 0.8, 1.2);

fn sky_scene(name: &str) -> Scene {
    let mut scene = empty_scene(name);
    scene.background = Background::Constant(SKY);
    scene
}

/// Renders a frame; at the pixels' centres, if `sampling` says so.
fn render_frame(scene: &Scene, size: [u32; 2], sampling: ColorSampling) -> Frame {
    let mut settings = settings(size, 16);
    settings.options.color = sampling;
    crate::renders::render_frame(scene, &settings)
}

#[test]
fn films_mix_their_own_light_with_what_they_let_pass() {
    let blue = Vec3::new(0.9, 0.5, 0.1);
    let grey = |level: f32| Vec3::splat(level);
    let bright = Vec3::new(2.0, 0.1, 0.5);
    // Opacity, radiance and filter, from the farthest to the nearest.
    let stacks = [
        vec![(0.0, bright, blue)],
        vec![(0.3, bright, blue)],
        vec![(0.8, bright, blue)],
        vec![
            (0.25, grey(0.0), grey(0.9)),
            (0.5, grey(1.0), grey(0.8)),
            (0.1, bright, grey(0.5)),
            (0.6, grey(3.0), grey(1.0)),
            (0.0, grey(4.0), blue),
        ],
    ];
    for films in stacks {
        let mut scene = sky_scene("films");
        let mut expected = SKY;
        // A film covers by its opacity, whatever its colour.
        let mut shares = vec![1.0];
        for (index, (opacity, radiance, filter)) in films.into_iter().enumerate() {
            hang(
                &mut scene,
                film(radiance, opacity, filter),
                -10.0 + index as f64,
            );
            expected = opacity * radiance + (1.0 - opacity) * filter * expected;
            shares.iter_mut().for_each(|share| *share *= 1.0 - opacity);
            shares.push(opacity);
        }
        let mean = render_small_truth(&scene, 16).mean();
        let frame = render_frame(&scene, [16, 9], ColorSampling::Antialiased);
        for picture in [mean, frame.picture()] {
            // Rounding of 16 sums: no sample differs from another.
            for pixel in &picture.color.pixels {
                assert_near(*pixel, expected, 5e-6, "films");
            }
            for (coverage, share) in picture.coverage.iter().zip(&shares) {
                let mut pixels = coverage.pixels.iter();
                assert!(pixels.all(|value| (value - share).abs() < 1e-6));
            }
        }
    }
}

#[test]
fn a_ray_through_the_common_edge_of_two_triangles_passes_one_film() {
    // Every pixel's centre on the diagonal is on the edge between the square's triangles.
    let mut scene = sky_scene("edge");
    hang(&mut scene, film(Vec3::ZERO, 0.5, Vec3::ONE), -4.0);
    let frame = render_frame(&scene, [9, 9], ColorSampling::Point);
    for pixel in &frame.color.pixels {
        assert_near(*pixel, 0.5 * SKY, 1e-6, "edge");
    }
}

/// Composites rectangles from far to near at a pixel's centre, without the tracer.
#[test]
fn films_at_random_look_as_a_painter_puts_them_on() {
    let mut random = Random::new(7);
    let mut unit = || f64::from(random.real(0.0, 1.0));
    let mut scene = sky_scene("painter");
    let mut sheets: Vec<(DVec3, [f64; 2], Vec3, f32, Vec3)> = (0..30)
        .map(|_| {
            let z = -2.0 - 8.0 * unit();
            let at = DVec3::new(z * (2.0 * unit() - 1.0), z * (unit() - 0.5), z);
            let size = [1.0 + 4.0 * unit(), 1.0 + 3.0 * unit()];
            let mut color = || Vec3::new(unit() as f32, unit() as f32, unit() as f32);
            let (radiance, filter) = (color(), color());
            (at, size, radiance, unit() as f32, filter)
        })
        .collect();
    for (at, [width, height], radiance, opacity, filter) in &sheets {
        let mesh = rectangle(*width as f32, *height as f32);
        let material = film(*radiance, *opacity, *filter);
        add(&mut scene, mesh, material, placed(*at));
    }
    sheets.sort_by(|a, b| a.0.z.total_cmp(&b.0.z));
    let frame = render_frame(&scene, [48, 27], ColorSampling::Point);
    for y in 0..27 {
        for x in 0..48 {
            // The view is 90 degrees high: at depth 1 the picture is 2 m high.
            let scale = 2.0 / 27.0;
            let [right, up] = [f64::from(x) + 0.5 - 24.0, 13.5 - (f64::from(y) + 0.5)];
            let mut expected = SKY;
            for (at, [width, height], radiance, opacity, filter) in &sheets {
                let [u, v] = [right, up].map(|place| place * scale * -at.z);
                if (u - at.x).abs() < 0.5 * width && (v - at.y).abs() < 0.5 * height {
                    expected = *opacity * *radiance + (1.0 - opacity) * *filter * expected;
                }
            }
            let what = format!("pixel {x}, {y}");
            assert_near(*frame.color.at(x, y), expected, 1e-5, &what);
        }
    }
}

#[test]
fn a_film_that_moves_counts_for_the_time_that_it_covers() {
    let (radiance, opacity, filter) = (Vec3::splat(3.0), 0.4, Vec3::splat(0.5));
    let normal = DVec2::from_angle(0.3);
    let mut scene = half_plane_scene(normal, &[-1.0, 1.0], |time| 2.3 + SPEED * time);
    scene.background = Background::Constant(SKY);
    scene.materials[0] = film(radiance, opacity, filter);
    let truth = render_truth(&scene, &truth_settings(), Alignment::Trailing);
    let mixed = opacity * radiance + (1.0 - opacity) * filter * SKY;
    let [sky, through] = [SKY, mixed].map(|color| f64::from(color.x));
    let mut estimates = estimate_pixels(&truth, |x, y| {
        let share = half_plane(pixel_corner(x, y), normal, 2.3, SPEED, truth.shutter);
        sky + share * (through - sky)
    });
    for estimate in &mut estimates {
        if estimate.expected != sky && estimate.expected != through {
            // Eight replicates may agree and be off by a sample: see `coverage_estimates`.
            estimate.floor = (0.21_f64 / 8.0).sqrt() / 128.0 * (through - sky);
        }
    }
    expect_agreement("moving film", &estimates, 8);
    let mean = truth.mean();
    for (color, matte) in mean.color.pixels.iter().zip(&mean.coverage[1].pixels) {
        let share = (f64::from(color[0]) - sky) / (through - sky);
        assert!((f64::from(opacity) * share - f64::from(*matte)).abs() < 1e-5);
    }
}

#[test]
fn glass_seen_straight_on_passes_and_reflects_by_fresnel_s_equations() {
    let filter = Vec3::new(1.0, 0.7, 0.1);
    let r = (0.5_f32 / 2.5).powi(2);
    let passed = (1.0 - r).powi(2) * filter / (Vec3::ONE - r * r * filter * filter);
    let reflected = Vec3::splat(r) + r * filter * passed;
    // A lamp behind the pane, then one behind the camera.
    for (lamp, expected) in [(-8.0, passed), (8.0, reflected)] {
        let mut scene = empty_scene("straight on");
        hang(&mut scene, glass(1.5, filter), -4.0);
        hang(&mut scene, glowing(1.0), lamp);
        // 0.01 radians from the axis change nothing that 32 bits show.
        scene.camera.vertical_fov = vec![(0.0, 0.01)];
        for pixel in &render_small_truth(&scene, 16).mean().color.pixels {
            assert_near(*pixel, expected, 2e-6, "straight on");
        }
    }
    // Without a tint: 2 r / (1 + r), 7.7 % of window glass.
    assert!((reflected.x - 2.0 * r / (1.0 + r)).abs() < 1e-7);
}

#[test]
fn a_slanted_pane_mirrors_what_lies_beside_it() {
    // At 45 degrees the pane shows the sky at the zenith.
    let mut scene = empty_scene("slanted");
    scene.background = heights(0.0, 0.0, 1.0);
    let turn = DQuat::from_rotation_x(-FRAC_PI_4);
    let tilted = turned(DVec3::new(0.0, 0.0, -4.0), turn);
    let pane = glass(1.5, Vec3::ONE);
    add(&mut scene, rectangle(1.0, 1.0), pane, tilted);
    scene.camera.vertical_fov = vec![(0.0, 0.002)];
    let r = fresnel(0.5_f64.sqrt(), 1.5);
    let expected = 2.0 * r / (1.0 + r);
    // The view is 0.002 radians high, and the horizon behind the pane shows with 0.001.
    expect_near("slanted", mean_radiance(&scene, 16), expected, 2e-3);
}
