//! Circles of confusion, against their closed forms.

use std::f64::consts::PI;

use frame::{Alignment, Frame};
use glam::{DVec2, DVec3};
use scene::Scene;

use super::with_lens;
use crate::moving_shapes::*;
use crate::renders::*;

/// Apertures and focus distances in front of the shapes and behind them. The circle of confusion at
/// the shapes has a diameter of aperture x |distance - focus| / focus = 5 metres, and a metre there
/// is a pixel.
const BLURS: [[f64; 2]; 2] = [[5.0, 0.5 * DISTANCE], [10.0, 2.0 * DISTANCE]];
const CIRCLE: f64 = 5.0;

/// Returns the integral up to `at` of the part of a disc around 0 below a chord, over the chord's
/// position.
fn disc_below(at: f64, radius: f64) -> f64 {
    if at.abs() >= radius {
        return at.max(0.0);
    }
    let root = (radius * radius - at * at).sqrt();
    let below = -root.powi(3) / 3.0 + radius * radius * (at * (at / radius).asin() + root);
    0.5 * at + below / (PI * radius * radius)
}

#[test]
fn motion_and_defocus_are_the_convolution_of_a_box_and_a_disc() {
    for (blur, alignment, angle, speed) in [
        // The edge is so slow that it is still: its blur is the mean of the disc's chords over a
        // hundredth of a pixel.
        (BLURS[0], Alignment::Centred, 0.4, 0.01),
        (BLURS[1], Alignment::Trailing, 0.0, SPEED),
        (BLURS[0], Alignment::Leading, 0.7, SPEED),
    ] {
        let [aperture, focus] = blur;
        let normal = DVec2::from_angle(angle);
        let along = |time: f64| 2.3 + speed * time;
        let edge = half_plane_scene(normal, &[-1.0, 1.0], along);
        let scene = with_lens(edge, aperture, focus);
        let what = format!("speed {speed}, focus {focus}");
        expect_coverage(&what, &scene, alignment, |pixel, shutter| {
            // Dense enough for an edge blurred by a lens.
            mean_over_pixel(pixel, 32, |point| {
                let [open, close] = [shutter.open, shutter.close]
                    .map(|time| disc_below(along(time) - normal.dot(point), 0.5 * CIRCLE));
                (close - open) / (speed * shutter.exposure())
            })
        });
    }
}

#[test]
fn a_small_disc_becomes_its_circle_of_confusion_and_keeps_its_light() {
    const SIDE: u32 = 8;
    let radius = 0.8;
    let centre = DVec2::new(0.4, -0.2);
    for [aperture, focus] in BLURS {
        let mut scene = empty_scene("disc");
        let place = placed(centre.extend(-DISTANCE));
        add(&mut scene, disc(radius as f32, 512), glowing(1.0), place);
        // A metre of the disc is a pixel of this smaller picture too.
        let slope = 0.5 * f64::from(SIDE) / DISTANCE;
        scene.camera.vertical_fov = vec![(0.0, 2.0 * slope.atan())];
        let settings = settings([SIDE, SIDE], 65_536);
        let frame = render_frame(&with_lens(scene, aperture, focus), &settings);
        let (mut light, mut moment, mut square) = (0.0, DVec2::ZERO, DVec2::ZERO);
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            let color = f64::from(frame.color.at(x, y)[0]);
            let [right, down] = [x, y].map(|at| f64::from(at) + 0.5 - 0.5 * f64::from(SIDE));
            let offset = DVec2::new(right, -down) - centre;
            // No part of the pixel comes near the circle.
            if offset.length() > 0.5 * CIRCLE + radius + 0.71 {
                assert_eq!(color, 0.0, "light at {offset}");
            }
            light += color;
            moment += color * offset;
            square += color * offset * offset;
        }
        let area = PI * radius * radius;
        // 130,000 samples hit the disc: three times the root of that is 0.8 %.
        let what = format!("focus {focus}");
        expect_near(&what, light / area, 1.0, 8e-3);
        assert!((moment / light).length() < 0.01, "{what}: {moment}");
        // Variances add up: the circle's of confusion, the disc's, and a pixel's. Measured to 0.6
        // %; a circle a hundredth too wide is off by 1.7 %.
        let expected = CIRCLE * CIRCLE / 16.0 + radius * radius / 4.0 + 1.0 / 12.0;
        for actual in (square / light).to_array() {
            expect_near(&what, actual, expected, 0.012 * expected);
        }
    }
}

#[test]
fn a_plane_in_focus_is_what_the_pinhole_sees() {
    let mut scene = empty_scene("plane");
    let at = DVec3::new(0.3, 0.1, -DISTANCE);
    add(&mut scene, disc(6.0, 64), glowing(0.7), placed(at));
    let render = |scene: &Scene| -> Frame { render_frame(scene, &settings([WIDTH, HEIGHT], 1024)) };
    let sharp = render(&scene);
    let focused = render(&with_lens(scene, 3.0, DISTANCE));
    let differ = (sharp.color.pixels.iter().zip(&focused.color.pixels))
        .map(|(sharp, focused)| (sharp[0] - focused[0]).abs());
    // The same points of the plane are sampled. One sample that falls to the other side of the edge
    // changes its pixel by 7e-4: of 40,000 in pixels at the edge, a focus wrong by a ten-thousandth
    // moves two.
    assert!(differ.fold(0.0, f32::max) < 1e-5);
}

#[test]
fn the_sky_at_infinity_has_a_circle_of_aperture_over_focus() {
    let mut scene = empty_scene("sky");
    scene.background = heights(0.0, 0.0, 8.0);
    let (aperture, focus) = (4.0, DISTANCE);
    let settings = settings([WIDTH, HEIGHT], 4096);
    let frame = render_frame(&with_lens(scene, aperture, focus), &settings);
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
                // Three positions in the pixel's height are enough for all: 0.01.
                let places = [0.5, 0.1, 0.9].map(|up| radiance(corner + DVec2::new(0.5, up)));
                sum += places.iter().sum::<f64>() / 3.0;
            }
        }
        let expected = sum / points;
        let actual = f64::from(frame.color.at(column, row)[0]);
        expect_near(&format!("row {row}"), actual, expected, 0.02);
    }
}
