//! Circles of confusion, against their closed forms.

use std::f64::consts::PI;

use frame::{Alignment, Frame};
use glam::{DVec2, DVec3, Vec3};
use tests::shapes::*;
use tests::unwatched;
use tracer::{Background, RenderSettings, Scene, trace_frame};

use super::with_lens;
use crate::moving_shapes::{
    DISTANCE, EXPOSURE, HEIGHT, SPEED, WIDTH, expect_coverage, pixel_corner, render_truth,
};

/// A lens and the diameter of its circle of confusion at the shapes' distance, in pixels: aperture x |distance - focus| / focus
/// metres there, and a metre there is a pixel.
struct Blur {
    aperture: f64,
    focus: f64,
    circle: f64,
}

/// Lenses that are focused in front of the shapes and behind them.
const BLURS: [Blur; 2] = [
    Blur {
        aperture: 5.0,
        focus: 0.5 * DISTANCE,
        circle: 5.0,
    },
    Blur {
        aperture: 10.0,
        focus: 2.0 * DISTANCE,
        circle: 5.0,
    },
];

/// Makes a half-plane of `normal` whose edge lies `offset` pixels from the centre at the instant.
fn half_plane_scene(normal: DVec2, offset: f64, speed: f64) -> Scene {
    let mut scene = empty_scene("edge");
    let place = (offset - 200.0) * normal;
    let velocity = speed * normal;
    let mut motion = drift(
        DVec3::new(place.x, place.y, -DISTANCE),
        velocity.extend(0.0),
    );
    for key in &mut motion.keys {
        key.orientation = glam::DQuat::from_rotation_z(normal.to_angle());
    }
    add(&mut scene, rectangle(400.0, 400.0), glowing(1.0), motion);
    scene
}

/// Returns the integral up to `at` of the part of a disc around 0 that lies below a chord, over the chord's place.
fn disc_below(at: f64, radius: f64) -> f64 {
    if at.abs() >= radius {
        return at.max(0.0);
    }
    let root = (radius * radius - at * at).sqrt();
    let below = -root.powi(3) / 3.0 + radius * radius * (at * (at / radius).asin() + root);
    0.5 * at + below / (PI * radius * radius)
}

/// Integrates over a pixel, by the midpoint rule on points that are dense enough for what a lens leaves of an edge.
fn mean_over_pixel(pixel: DVec2, value: impl Fn(DVec2) -> f64) -> f64 {
    const SIDE: u32 = 32;
    let at = |index: u32| (f64::from(index) + 0.5) / f64::from(SIDE);
    let points = (0..SIDE * SIDE).map(|index| DVec2::new(at(index % SIDE), at(index / SIDE)));
    points.map(|point| value(pixel + point)).sum::<f64>() / f64::from(SIDE * SIDE)
}

#[test]
fn an_edge_is_the_integral_of_the_disc_s_chords() {
    let normal = DVec2::from_angle(0.4);
    for Blur {
        aperture,
        focus,
        circle,
    } in BLURS
    {
        // So slow that it is still: the chord's mean over a thousandth of a pixel.
        let scene = with_lens(half_plane_scene(normal, 1.3, 1e-3), aperture, focus);
        let truth = render_truth(&scene, Alignment::Centred);
        expect_coverage(&format!("edge, focus {focus}"), &truth, |x, y| {
            mean_over_pixel(pixel_corner(x, y), |point| {
                let at = 1.3 - normal.dot(point);
                let step = 1e-4;
                let radius = 0.5 * circle;
                (disc_below(at + step, radius) - disc_below(at - step, radius)) / (2.0 * step)
            })
        });
    }
}

#[test]
fn motion_and_defocus_together_are_the_convolution_of_a_box_and_a_disc() {
    for (
        Blur {
            aperture,
            focus,
            circle,
        },
        angle,
    ) in BLURS.into_iter().zip([0.0, 0.7])
    {
        let normal = DVec2::from_angle(angle);
        for alignment in Alignment::ALL {
            let scene = with_lens(half_plane_scene(normal, 2.3, SPEED), aperture, focus);
            let truth = render_truth(&scene, alignment);
            let shutter = truth.shutter;
            expect_coverage(&format!("{alignment}, focus {focus}"), &truth, |x, y| {
                mean_over_pixel(pixel_corner(x, y), |point| {
                    let at = |time: f64| 2.3 + SPEED * time - normal.dot(point);
                    let [open, close] = [shutter.open, shutter.close]
                        .map(|time| disc_below(at(time), 0.5 * circle));
                    (close - open) / (SPEED * EXPOSURE)
                })
            });
        }
    }
}

/// Renders the frame with many samples per pixel.
fn render_frame(scene: &Scene) -> Frame {
    let settings = RenderSettings {
        width: WIDTH,
        height: HEIGHT,
        samples_per_pixel: 65_536,
        ..RenderSettings::default()
    };
    trace_frame(scene, &settings, &unwatched).expect("settings are allowed")
}

#[test]
fn a_small_disc_becomes_its_circle_of_confusion_and_keeps_its_light() {
    let radius = 0.8;
    let centre = DVec2::new(0.4, -0.2);
    for Blur {
        aperture,
        focus,
        circle,
    } in BLURS
    {
        let mut scene = empty_scene("disc");
        let place = placed(centre.extend(-DISTANCE));
        add(&mut scene, disc(radius as f32, 512), glowing(1.0), place);
        let frame = render_frame(&with_lens(scene, aperture, focus));
        let (mut light, mut moment, mut square) = (0.0, DVec2::ZERO, DVec2::ZERO);
        for y in 0..HEIGHT {
            for x in 0..WIDTH {
                let color = f64::from(frame.color.at(x, y)[0]);
                let offset = pixel_corner(x, y) + 0.5 - centre;
                // No part of the pixel comes near the circle.
                if offset.length() > 0.5 * circle + radius + 0.71 {
                    assert_eq!(color, 0.0, "light at {offset}");
                }
                light += color;
                moment += color * offset;
                square += color * offset * offset;
            }
        }
        let area = PI * radius * radius;
        // 130,000 samples meet the disc: three times the root of that is 0.8 %.
        assert!(
            (light / area - 1.0).abs() < 8e-3,
            "focus {focus}: {light} of {area}"
        );
        assert!((moment / light).length() < 0.01, "focus {focus}: {moment}");
        // Variances add up: of the circle of confusion, of the disc, and of a pixel. Measured to 0.6 %; a circle that is a hundredth
        // too wide is off by 1.7 %.
        let expected = circle * circle / 16.0 + radius * radius / 4.0 + 1.0 / 12.0;
        let error = square / light - DVec2::splat(expected);
        assert!(
            error.abs().max_element() < 0.012 * expected,
            "focus {focus}: {square} over {light}, not {expected}"
        );
    }
}

#[test]
fn a_plane_in_focus_is_what_the_pinhole_sees() {
    let mut scene = empty_scene("plane");
    let at = DVec3::new(0.3, 0.1, -DISTANCE);
    add(&mut scene, disc(6.0, 64), glowing(0.7), placed(at));
    let sharp = render_frame(&scene);
    let focused = render_frame(&with_lens(scene.clone(), 3.0, DISTANCE));
    let differ = (sharp.color.pixels.iter().zip(&focused.color.pixels))
        .map(|(sharp, focused)| (sharp[0] - focused[0]).abs());
    // The same places of the plane are sampled; a sample at the very edge may fall to the other side of it.
    assert!(differ.fold(0.0, f32::max) < 1e-4);
    let blurred = render_frame(&with_lens(scene, 3.0, 0.8 * DISTANCE));
    assert_ne!(sharp.color, blurred.color);
}

#[test]
fn the_sky_at_infinity_has_a_circle_of_aperture_over_focus() {
    let mut scene = empty_scene("sky");
    scene.background = Background::Gradient {
        ground: Vec3::ZERO,
        horizon: Vec3::ZERO,
        zenith: Vec3::splat(8.0),
    };
    let (aperture, focus) = (4.0, DISTANCE);
    let frame = render_frame(&with_lens(scene, aperture, focus));
    let circle = aperture / focus * DISTANCE;
    let radiance = |place: DVec2| 8.0 * place.extend(DISTANCE).normalize().y.max(0.0);
    let column = WIDTH / 2 - 3;
    for row in 0..HEIGHT {
        let mut points = 0.0;
        let mut sum = 0.0;
        // A square grid over the disc, one row of it at a time.
        for index in 0..64 * 64 {
            let at = |index: u32| (f64::from(index) + 0.5) / 32.0 - 1.0;
            let shift = DVec2::new(at(index % 64), at(index / 64));
            if shift.length() < 1.0 {
                points += 1.0;
                let corner = pixel_corner(column, row) + 0.5 * circle * shift;
                sum += radiance(corner + 0.5)
                    + radiance(corner + DVec2::new(0.5, 0.1))
                    + radiance(corner + DVec2::new(0.5, 0.9));
            }
        }
        let expected = sum / (3.0 * points);
        let found = f64::from(frame.color.at(column, row)[0]);
        // Three places of the pixel's height stand for all: 0.01.
        assert!(
            (found - expected).abs() < 0.02,
            "row {row}: {found}, not {expected}"
        );
    }
}
