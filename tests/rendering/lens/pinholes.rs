//! The second estimator: a lens is the mean of the pinholes at its points.

use frame::{Alignment, AtInstant, Frame, Picture, Truth};
use glam::{DVec2, DVec3, Vec3};
use tests::shapes::*;
use tests::unwatched;
use tracer::{
    Background, Camera, Key, Motion, PixelGrid, RenderSettings, Scene, trace_frame,
    trace_frame_part, trace_truth,
};

use super::with_lens;

const WIDTH: u32 = 32;
const HEIGHT: u32 = 18;
/// Focal length in pixels, at a vertical field of view of 90 degrees.
const FOCAL: f64 = 0.5 * HEIGHT as f64;
const APERTURE: f64 = 0.8;
const FOCUS: f64 = 4.0;
/// Points along each axis of the square that holds the lens.
const SIDE: u32 = 14;

/// Lists points of the lens on a square grid, in metres; +x right, +y up. It shares no code with the tracer's.
fn lens_points() -> Vec<DVec2> {
    let at = |index: u32| (2.0 * f64::from(index) + 1.0) / f64::from(SIDE) - 1.0;
    let square = (0..SIDE * SIDE).map(|index| DVec2::new(at(index % SIDE), at(index / SIDE)));
    let disc = square.filter(|point| point.length() < 1.0);
    disc.map(|point| 0.5 * APERTURE * point).collect()
}

fn settings(samples_per_pixel: u32) -> RenderSettings {
    RenderSettings {
        width: WIDTH,
        height: HEIGHT,
        samples_per_pixel,
        replicates: 2,
        exposure: Some(0.5),
        ..RenderSettings::default()
    }
}

/// Makes spheres in front of the focus, in it and behind it, under a sky, seen by a camera that looks to the side.
fn spheres() -> Scene {
    let mut scene = empty_scene("spheres");
    scene.background = Background::Gradient {
        ground: Vec3::ZERO,
        horizon: Vec3::splat(0.3),
        zenith: Vec3::splat(0.6),
    };
    for (place, radiance) in [
        (DVec3::new(-0.6, -0.3, -2.0), 1.0),
        (DVec3::new(0.7, 0.2, -4.0), 0.8),
        (DVec3::new(2.5, 1.0, -9.0), 0.9),
    ] {
        let radius = -0.2 * place.z as f32;
        add(
            &mut scene,
            icosphere(radius, 2),
            glowing(radiance),
            placed(place),
        );
    }
    let turn = glam::DQuat::from_euler(glam::EulerRot::YXZ, 0.2, -0.1, 0.3);
    scene.camera.motion = Motion::still(Key {
        translation: DVec3::new(0.3, 0.1, 0.2),
        orientation: turn,
        ..Key::REST
    });
    scene
}

#[test]
fn a_frame_is_the_mean_of_shifted_pinhole_frames() {
    let own = trace_frame(
        &with_lens(spheres(), APERTURE, FOCUS),
        &settings(1024),
        &unwatched,
    )
    .unwrap();
    let pinholes: Vec<Frame> = (lens_points().into_iter())
        .map(|point| {
            let mut scene = spheres();
            let Camera { motion, .. } = &mut scene.camera;
            let key = &mut motion.keys[0];
            key.translation += key.orientation * point.extend(0.0);
            // A camera beside the lens' centre sees the plane in focus beside its place.
            let offset = FOCAL / FOCUS * DVec2::new(-point.x, point.y);
            let grid = PixelGrid {
                size: [WIDTH, HEIGHT],
                offset: offset.into(),
            };
            trace_frame_part(&scene, &settings(64), &grid, None, &unwatched).unwrap()
        })
        .collect();
    let pictures = |frame: &Frame| Picture {
        color: frame.color.clone(),
        coverage: frame.coverage.clone(),
    };
    let pinholes: Vec<Picture> = pinholes.iter().map(pictures).collect();
    expect_same(&pictures(&own), &Picture::mean(&pinholes));
}

/// Compares a picture with a mean over the points of the lens. 156 points give an edge steps of 1 / 156 and the disc a rim of squares:
/// 0.02 (measured 0.013 at most).
fn expect_same(own: &Picture, mean: &Picture) {
    let off = |own: f32, mean: f32| assert!((own - mean).abs() < 0.025, "{own} is not {mean}");
    for (own, mean) in own.color.pixels.iter().zip(&mean.color.pixels) {
        off(own[0], mean[0]);
    }
    for (own, mean) in own.coverage.iter().zip(&mean.coverage) {
        let pixels = own.pixels.iter().zip(&mean.pixels);
        pixels.for_each(|(own, mean)| off(*own, *mean));
    }
}

/// Makes panels across the view that drift before and behind the focus, as the pinhole at a point of the lens sees them: what lies in
/// focus stays, and the rest is moved.
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
    scene
}

fn render_truth(scene: &Scene, samples_per_pixel: u32) -> Truth {
    trace_truth(
        scene,
        &settings(samples_per_pixel),
        Alignment::Trailing,
        &unwatched,
    )
    .unwrap()
}

#[test]
fn every_layer_of_a_truth_is_the_mean_of_shifted_pinhole_truths() {
    let own = render_truth(&with_lens(panels(DVec2::ZERO), APERTURE, FOCUS), 2048);
    let pinholes: Vec<Truth> = (lens_points().into_iter())
        .map(|point| render_truth(&panels(point), 64))
        .collect();
    let pictures: Vec<Picture> = pinholes.iter().map(Truth::mean).collect();
    expect_same(&own.mean(), &Picture::mean(&pictures));

    let layers: Vec<AtInstant> = pinholes.iter().map(Truth::at_instant_mean).collect();
    let found = own.at_instant_mean();
    let count = layers.len() as f32;
    let mean = |of: &dyn Fn(&AtInstant) -> f32| layers.iter().map(of).sum::<f32>() / count;
    for pixel in 0..(WIDTH * HEIGHT) as usize {
        let compare = |what: &str, tolerance: f32, of: &dyn Fn(&AtInstant) -> f32| {
            let (found, expected) = (of(&found), mean(of));
            assert!(
                (found - expected).abs() < tolerance,
                "{what} of pixel {pixel}: {found}, not {expected}"
            );
        };
        compare("frozen", 0.025, &|layers| layers.frozen.pixels[pixel][0]);
        compare("unknowable", 0.03, &|layers| {
            layers.unknowable.pixels[pixel]
        });
        compare("placed", 1e-5, &|layers| layers.placed.pixels[pixel]);
        // The panels move by 3 and 2.8 pixels while the shutter is open.
        compare("offset x", 0.1, &|layers| layers.offset.pixels[pixel][0]);
        compare("offset y", 0.1, &|layers| layers.offset.pixels[pixel][1]);
        compare("spread xx", 0.3, &|layers| layers.spread.pixels[pixel][0]);
        compare("spread yy", 0.3, &|layers| layers.spread.pixels[pixel][2]);
    }
}
