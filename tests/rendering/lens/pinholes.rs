//! The second estimator: a lens is the mean of the pinholes at its points.

use frame::{Alignment, AtInstant, Frame, Picture, Truth};
use glam::{DQuat, DVec2, DVec3, EulerRot};
use scene::Scene;
use tracer::{PixelGrid, trace_frame_part};

use super::with_lens;
use crate::renders::*;

const SIZE: [u32; 2] = [20, 12];
/// Focal length in pixels, at a vertical field of view of 90 degrees.
const FOCAL: f64 = 0.5 * SIZE[1] as f64;
const APERTURE: f64 = 1.2;
const FOCUS: f64 = 4.0;

/// Lists points of the lens on the spiral of a sunflower (Vogel 1979), in metres; +x right, +y up.
/// It shares no code with the tracer.
fn lens_points(count: u32) -> impl Iterator<Item = DVec2> {
    let golden_angle = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    (0..count).map(move |index| {
        let radius = ((f64::from(index) + 0.5) / f64::from(count)).sqrt();
        0.5 * APERTURE * radius * DVec2::from_angle(golden_angle * f64::from(index))
    })
}

/// Makes spheres in front of the focus, in it and behind it, under a sky, seen by a camera that
/// looks to the side.
fn spheres() -> Scene {
    let mut scene = empty_scene("spheres");
    scene.background = heights(0.0, 0.3, 0.6);
    for (place, radiance) in [
        (DVec3::new(-0.6, -0.3, -2.0), 1.0),
        (DVec3::new(0.7, 0.2, -4.0), 0.8),
        (DVec3::new(2.5, 1.0, -9.0), 0.9),
    ] {
        let sphere = icosphere(-0.2 * place.z as f32, 2);
        add(&mut scene, sphere, glowing(radiance), placed(place));
    }
    let turn = DQuat::from_euler(EulerRot::YXZ, 0.2, -0.1, 0.3);
    scene.camera.motion = turned(DVec3::new(0.3, 0.1, 0.2), turn);
    scene
}

#[test]
#[ignore = "prove: frames; each test run renders truths through pinholes"]
fn a_frame_is_the_mean_of_shifted_pinhole_frames() {
    let lens = with_lens(spheres(), APERTURE, FOCUS);
    let frame = render_frame(&lens, &settings_of_two(SIZE, 2048));
    let pinholes = lens_points(160).zip(1..).map(|(point, seed)| {
        let mut scene = spheres();
        let key = &mut scene.camera.motion.keys[0];
        key.translation += key.orientation * point.extend(0.0);
        // A camera next to the lens's centre sees the plane in focus shifted.
        let offset = FOCAL / FOCUS * DVec2::new(-point.x, point.y);
        let grid = PixelGrid {
            size: SIZE.into(),
            offset: offset.into(),
        };
        // With one seed all pinholes would have the same noise, which would stay in the mean.
        let mut settings = settings_of_two(SIZE, 16);
        settings.seed = seed;
        let traced = trace_frame_part(&scene, &settings, &grid, None, &unwatched);
        traced.unwrap().frame
    });
    let pictures: Vec<Picture> = pinholes.map(|frame: Frame| frame.picture()).collect();
    expect_same(&frame.picture(), &Picture::mean(&pictures));
}

/// Compares a picture with a mean over the points of the lens. Points next to an edge make up 0.02
/// of it (measured 0.017 at most).
fn expect_same(picture: &Picture, mean: &Picture) {
    let mut worst = 0.0_f32;
    let mut off = |value: f32, mean: f32| worst = worst.max((value - mean).abs());
    for (pixel, mean) in picture.color.pixels.iter().zip(&mean.color.pixels) {
        off(pixel[0], mean[0]);
    }
    for (matte, mean) in picture.coverage.iter().zip(&mean.coverage) {
        let pixels = matte.pixels.iter().zip(&mean.pixels);
        pixels.for_each(|(value, mean)| off(*value, *mean));
    }
    assert!(worst < 0.025, "{worst}");
}

/// Makes panels across the view that drift in front of and behind the focus, as seen by the pinhole
/// at a point of the lens: panels in focus stay, and the rest is moved.
fn panels(point: DVec2) -> Scene {
    let mut scene = empty_scene("panels");
    for (place, velocity, size, radiance) in [
        ([0.0, 0.0, -8.0], [0.0, 0.0], 200.0, 0.2),
        ([1.5, 0.5, -6.0], [-4.0, 1.0], 5.0, 0.9),
        ([-0.3, 0.0, -2.0], [1.2, 0.3], 1.1, 0.5),
    ] {
        let shift = point * (1.0 + place[2] / FOCUS);
        let at = DVec3::from(place) - shift.extend(0.0);
        let motion = drift(at, DVec2::from(velocity).extend(0.0));
        add(&mut scene, rectangle(size, size), glowing(radiance), motion);
    }
    scene.exposure = 0.5;
    scene
}

#[test]
fn every_layer_of_a_truth_is_the_mean_of_shifted_pinhole_truths() {
    let render = |scene: &Scene, samples: u32| -> Truth {
        let settings = settings_of_two(SIZE, samples);
        render_truth(scene, &settings, Alignment::Trailing)
    };
    let truth = render(&with_lens(panels(DVec2::ZERO), APERTURE, FOCUS), 4096);
    let pinholes: Vec<Truth> = lens_points(64)
        .map(|point| render(&panels(point), 128))
        .collect();
    let pictures: Vec<Picture> = pinholes.iter().map(Truth::mean).collect();
    expect_same(&truth.mean(), &Picture::mean(&pictures));

    let known = truth.at_instant_mean();
    let layers: Vec<AtInstant> = pinholes.iter().map(Truth::at_instant_mean).collect();
    let mean =
        |of: &dyn Fn(&AtInstant) -> f32| layers.iter().map(of).sum::<f32>() / layers.len() as f32;
    for pixel in 0..known.placed.pixels.len() {
        let compare = |what: &str, tolerance: f64, of: &dyn Fn(&AtInstant) -> f32| {
            let [actual, expected] = [of(&known), mean(of)].map(f64::from);
            let what = format!("{what} of pixel {pixel}");
            expect_near(&what, actual, expected, tolerance);
        };
        compare("shift", 0.025, &|instant| instant.shift.pixels[pixel][0]);
        compare("unknowable", 0.03, &|instant| {
            instant.unknowable.pixels[pixel]
        });
        compare("placed", 1e-5, &|instant| instant.placed.pixels[pixel]);
        // The panels move by 2 and 1.9 pixels while the shutter is open.
        compare("offset x", 0.1, &|instant| instant.offset.pixels[pixel][0]);
        compare("offset y", 0.1, &|instant| instant.offset.pixels[pixel][1]);
        compare("spread xx", 0.3, &|instant| instant.spread.pixels[pixel][0]);
        compare("spread yy", 0.3, &|instant| instant.spread.pixels[pixel][1]);
    }
}
