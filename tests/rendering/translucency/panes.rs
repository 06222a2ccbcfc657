//! Films and stacks of films, still and moving.

use frame::{Alignment, ColorSampling, Frame};
use glam::{DVec3, Vec3};
use tests::random::Random;
use tests::shapes::*;
use tests::statistics::{estimate_pixels, expect_agreement};
use tests::unwatched;
use tracer::{Background, RenderSettings, Scene, trace_frame, trace_truth};

use super::{assert_near, film, hang};
use crate::small_truths::render_truth;

const SKY: Vec3 = Vec3::new(0.4, 0.8, 1.2);

fn sky_scene(name: &str) -> Scene {
    let mut scene = empty_scene(name);
    scene.background = Background::Constant(SKY);
    scene
}

/// Renders a frame; at the pixels' centres, if `sampling` says so.
fn render_frame(scene: &Scene, [width, height]: [u32; 2], sampling: ColorSampling) -> Frame {
    let mut settings = RenderSettings {
        width,
        height,
        samples_per_pixel: 16,
        ..RenderSettings::default()
    };
    settings.options.color = sampling;
    trace_frame(scene, &settings, &unwatched).expect("settings are allowed")
}

#[test]
fn a_film_mixes_its_own_light_with_what_it_lets_pass() {
    let (own, filter) = (Vec3::new(2.0, 0.1, 0.5), Vec3::new(0.9, 0.5, 0.1));
    for opacity in [0.0, 0.3, 0.8] {
        let mut scene = sky_scene("film");
        hang(&mut scene, film(own, opacity, filter), -4.0);
        let expected = opacity * own + (1.0 - opacity) * filter * SKY;
        let mean = render_truth(&scene, 16).mean();
        let frame = render_frame(&scene, [16, 9], ColorSampling::Antialiased);
        // Rounding of 16 sums: no sample differs from another.
        for pixel in mean.color.pixels.iter().chain(&frame.color.pixels) {
            assert_near(*pixel, expected, 2e-6, "film");
        }
        // A film covers what its opacity says, whatever its colour.
        for coverage in [&mean.coverage, &frame.coverage] {
            for (id, share) in [1.0 - opacity, opacity].into_iter().enumerate() {
                let found = coverage[id].pixels.iter();
                assert!(found.into_iter().all(|own| (own - share).abs() < 1e-6));
            }
        }
    }
}

#[test]
fn stacked_films_let_the_product_pass() {
    let parts = [(0.25, 0.9), (0.5, 0.8), (0.1, 0.5), (0.6, 1.0), (0.0, 0.7)];
    let mut scene = sky_scene("stack");
    let mut expected = SKY;
    // From the farthest to the nearest.
    for (index, (opacity, filter)) in parts.into_iter().enumerate() {
        let (own, filter) = (Vec3::splat(index as f32), Vec3::splat(filter));
        hang(&mut scene, film(own, opacity, filter), -10.0 + index as f64);
        expected = opacity * own + (1.0 - opacity) * filter * expected;
    }
    let mean = render_truth(&scene, 16).mean();
    for pixel in &mean.color.pixels {
        assert_near(*pixel, expected, 5e-6, "stack");
    }
    let sum: f32 = mean.coverage.iter().map(|plane| plane.pixels[0]).sum();
    assert!((sum - 1.0).abs() < 1e-6, "{sum}");
    let left: f32 = parts.iter().map(|(opacity, _)| 1.0 - opacity).product();
    assert!((mean.coverage[0].pixels[0] - left).abs() < 1e-6);
}

#[test]
fn a_ray_through_the_common_edge_of_two_triangles_passes_one_film() {
    // Every pixel's centre on the diagonal lies on the edge between the square's triangles.
    let mut scene = sky_scene("edge");
    hang(&mut scene, film(Vec3::ZERO, 0.5, Vec3::ONE), -4.0);
    let frame = render_frame(&scene, [9, 9], ColorSampling::Point);
    for pixel in &frame.color.pixels {
        assert_near(*pixel, 0.5 * SKY, 1e-6, "edge");
    }
}

/// Composites rectangles from far to near at a pixel's centre: no tracer takes part.
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
            let (own, filter) = (color(), color());
            (at, size, own, unit() as f32, filter)
        })
        .collect();
    for (at, [width, height], own, opacity, filter) in &sheets {
        let mesh = rectangle(*width as f32, *height as f32);
        let material = film(*own, *opacity, *filter);
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
            for (at, [width, height], own, opacity, filter) in &sheets {
                let [u, v] = [right, up].map(|place| place * scale * -at.z);
                if (u - at.x).abs() < 0.5 * width && (v - at.y).abs() < 0.5 * height {
                    expected = *opacity * *own + (1.0 - opacity) * *filter * expected;
                }
            }
            let what = format!("pixel {x}, {y}");
            assert_near(*frame.color.at(x, y), expected, 1e-5, &what);
        }
    }
}

#[test]
fn a_film_that_moves_counts_for_the_time_that_it_covers() {
    const HEIGHT: u32 = 6;
    const WIDTH: u32 = 32;
    let (own, opacity, filter) = (Vec3::splat(3.0), 0.4, Vec3::splat(0.5));
    let mut scene = sky_scene("moving film");
    // One metre is one pixel; 10 pixels per frame to the right, 5.5 wide.
    let (speed, wide) = (10.0, 5.5);
    let motion = drift(
        DVec3::new(0.0, 0.0, -0.5 * f64::from(HEIGHT)),
        speed * DVec3::X,
    );
    add(
        &mut scene,
        rectangle(wide as f32, 100.0),
        film(own, opacity, filter),
        motion,
    );
    let settings = RenderSettings {
        width: WIDTH,
        height: HEIGHT,
        exposure: Some(0.7),
        samples_per_pixel: 512,
        ..RenderSettings::default()
    };
    let truth = trace_truth(&scene, &settings, Alignment::Trailing, &unwatched).expect("allowed");
    let covered = |x: u32| {
        let left = f64::from(x) - 0.5 * f64::from(WIDTH);
        let steps = 20_000;
        let share = |step: u32| {
            let time = -0.7 * (f64::from(step) + 0.5) / f64::from(steps);
            let [from, to] = [-0.5, 0.5].map(|side| speed * time + side * wide);
            (to.min(left + 1.0) - from.max(left)).max(0.0)
        };
        (0..steps).map(share).sum::<f64>() / f64::from(steps)
    };
    let shares: Vec<f64> = (0..WIDTH).map(covered).collect();
    let [sky, through] =
        [SKY, opacity * own + (1.0 - opacity) * filter * SKY].map(|color| f64::from(color.x));
    let mut estimates = estimate_pixels(&truth, |x, _| sky + shares[x as usize] * (through - sky));
    for estimate in &mut estimates {
        if estimate.expected != sky && estimate.expected != through {
            // Eight replicates may agree and be off by a sample: see `coverage_estimates`.
            estimate.floor = (0.21_f64 / 8.0).sqrt() / 64.0 * (through - sky);
        }
    }
    expect_agreement("moving film", &estimates, 8);
    let matte = &truth.mean().coverage[1];
    for x in 0..WIDTH {
        let found: f32 = (0..HEIGHT).map(|y| matte.at(x, y)).sum();
        let expected = f64::from(HEIGHT) * f64::from(opacity) * shares[x as usize];
        // 3072 stratified samples in a column.
        assert!(
            (f64::from(found) - expected).abs() < 0.02,
            "{x}: {found} {expected}"
        );
    }
}
