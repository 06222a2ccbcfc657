//! Coverage of shapes in motion, against closed forms.

use frame::{Alignment, Shutter};
use glam::{DVec2, DVec3};
use tests::half_plane::half_plane;

use crate::moving_shapes::*;
use crate::renders::*;

/// Checks of one shape's coverage, by alignment, angle of its motion, and exposure.
const SHAPES: [fn(Alignment, f64, f64); 3] = [expect_half_plane, expect_reversals, expect_disc];
/// Directions of motion, in degrees.
const ANGLES: [f64; 4] = [0.0, 30.0, 45.0, 90.0];

#[test]
fn shapes_in_motion_cover_what_their_closed_forms_say() {
    for (number, expect) in SHAPES.into_iter().enumerate() {
        for (index, alignment) in Alignment::ALL.into_iter().enumerate() {
            // Every alignment is run with three angles, and each shape with three exposures.
            let degrees = ANGLES[(index + number) % 4];
            expect(alignment, degrees.to_radians(), [0.75, 1.0, 0.4][index]);
        }
    }
}

#[test]
#[ignore = "prove: every shape in every alignment at every angle"]
fn every_shape_covers_what_its_closed_form_says_in_every_shutter_at_every_angle() {
    for expect in SHAPES {
        for alignment in Alignment::ALL {
            for degrees in ANGLES {
                expect(alignment, degrees.to_radians(), 0.75);
            }
        }
    }
}

/// Returns the length of the common part of two intervals.
fn overlap(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[1].min(b[1]) - a[0].max(b[0])).max(0.0)
}

/// The edge is 2.3 pixels ahead of the centre at the instant. Motion is not along its normal.
fn expect_half_plane(alignment: Alignment, angle: f64, exposure: f64) {
    let normal = DVec2::from_angle(angle);
    let velocity = SPEED * DVec2::from_angle(angle + 0.35);
    let place = |time: f64| (2.3 - 200.0) * normal + time * velocity;
    let mut scene = moving_scene(rectangle(400.0, 400.0), angle, &[-1.0, 1.0], place);
    scene.exposure = exposure;
    let speed = velocity.dot(normal);
    let what = format!("half-plane at {angle}");
    expect_coverage(&what, &scene, alignment, |pixel, shutter| {
        half_plane(pixel, normal, 2.3, speed, shutter)
    });
}

/// An edge goes forward, back at a higher speed, and forward again, with keys inside the shutter of
/// every alignment.
fn expect_reversals(alignment: Alignment, angle: f64, exposure: f64) {
    let times = [-0.9, -0.4, -0.2, 0.1, 0.3, 0.9];
    let places = [0.0, 6.0, 1.0, 3.0, -2.0, 5.0];
    let along = |time: f64| places[times.iter().position(|at| *at == time).expect("a key")];
    let normal = DVec2::from_angle(angle);
    let mut scene = half_plane_scene(normal, &times, along);
    scene.exposure = exposure;
    expect_coverage("reversals", &scene, alignment, |pixel, shutter| {
        let mut covered = 0.0;
        for index in 0..5 {
            let [(first, start), (last, end)] =
                [index, index + 1].map(|key| (times[key], places[key]));
            // Before the first key and after the last the motion continues.
            let from = if index == 0 { -1.0 } else { first };
            let to = if index == 4 { 1.0 } else { last };
            let span = [from.max(shutter.open), to.min(shutter.close)];
            if span[0] < span[1] {
                let speed = (end - start) / (last - first);
                let part = Shutter::new(span[0], span[1]).expect("not empty");
                let share = half_plane(pixel, normal, start - speed * first, speed, part);
                covered += part.exposure() / shutter.exposure() * share;
            }
        }
        covered
    });
}

/// A point is covered while the disc's chord through it passes.
fn expect_disc(alignment: Alignment, angle: f64, exposure: f64) {
    let radius = 4.4;
    let along = DVec2::from_angle(angle);
    let centre = DVec2::new(0.7, -0.3);
    let mesh = disc(radius as f32, 2048);
    let mut scene = moving_scene(mesh, 0.0, &[-1.0, 1.0], |time| {
        centre + SPEED * time * along
    });
    scene.exposure = exposure;
    let what = format!("disc at {angle}");
    expect_coverage(&what, &scene, alignment, |pixel, shutter| {
        let travel = [SPEED * shutter.open, SPEED * shutter.close];
        // Outside of the smear, nothing is covered.
        let middle = pixel + 0.5 - centre;
        let nearest = along * middle.dot(along).clamp(travel[0], travel[1]);
        if middle.distance(nearest) > radius + 1.0 {
            return 0.0;
        }
        let share = |point: DVec2| {
            let place = point - centre;
            let across = place.dot(along.perp());
            let half_chord = (radius * radius - across * across).max(0.0).sqrt();
            let inside = [place.dot(along) - half_chord, place.dot(along) + half_chord];
            overlap(inside, travel) / (SPEED * shutter.exposure())
        };
        // The chord's end has a root: the error is (1/128)^1.5 x 0.2 x sqrt(2 radius) / travel =
        // 5e-5 in the pixels that it crosses. Standard errors are above 2e-4.
        mean_over_pixel(pixel, 128, share)
    });
}

#[test]
fn a_rotating_bar_covers_its_sector_of_the_annulus() {
    let (inner, outer, half_width) = (2.0, 7.5, 0.8);
    let rate = 1.9;
    let mut scene = empty_scene("bar");
    scene.exposure = 0.75;
    let mut bar = rectangle((outer - inner) as f32, 2.0 * half_width as f32);
    for position in &mut bar.positions {
        position.x += 0.5 * (inner + outer) as f32;
    }
    let centre = DVec3::new(0.0, 0.0, -DISTANCE);
    add(&mut scene, bar, glowing(1.0), spin(centre, DVec3::Z, rate));
    for alignment in Alignment::ALL {
        expect_coverage("bar", &scene, alignment, |pixel, shutter| {
            // Outside of the annulus, nothing is covered.
            if (pixel + 0.5).length() > outer + half_width + 1.0 {
                return 0.0;
            }
            let swept = [rate * shutter.open, rate * shutter.close];
            let share = |point: DVec2| {
                let distance = point.length();
                if !(inner..outer + half_width).contains(&distance) {
                    return 0.0;
                }
                let angle = |length: f64| (length / distance).min(1.0).acos();
                let nearest = angle(outer);
                let farthest = (half_width / distance).min(1.0).asin().min(angle(inner));
                if farthest <= nearest {
                    return 0.0;
                }
                // The bar's angles that contain the point are on both sides of the point's own
                // angle.
                let turn = point.to_angle();
                let sides = overlap(swept, [turn + nearest, turn + farthest])
                    + overlap(swept, [turn - farthest, turn - nearest]);
                sides / (swept[1] - swept[0])
            };
            // The share jumps by up to 0.1 across the bar's end: 1e-4 by the midpoint rule.
            // Standard errors are 1e-3.
            mean_over_pixel(pixel, 128, share)
        });
    }
}

#[test]
fn noise_falls_as_stratification_predicts() {
    let normal = DVec2::from_angle(30f64.to_radians());
    let scene = half_plane_scene(normal, &[-1.0, 1.0], |time| 2.3 + SPEED * time);
    let rms = |samples: u32| {
        let settings = settings_of_two([WIDTH, HEIGHT], 2 * samples);
        let truth = render_truth(&scene, &settings, Alignment::Trailing);
        let mut squares = Vec::new();
        for (x, y) in (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))) {
            let exact = half_plane(pixel_corner(x, y), normal, 2.3, SPEED, truth.shutter);
            if exact > 0.0 && exact < 1.0 {
                let halves = truth.halves.iter();
                let off = halves.map(|half| f64::from(*half.coverage[1].at(x, y)) - exact);
                squares.extend(off.map(|off| off * off));
            }
        }
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    };
    let slope = (rms(512) / rms(16)).log2() / (512.0_f64 / 16.0).log2();
    // Random samples fall with -0.5; Owen-scrambled points in three dimensions fall with about
    // -0.75.
    assert!(slope > -1.0 && slope < -0.6, "slope is {slope}");
}
