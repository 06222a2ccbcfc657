//! Coverage of shapes in motion, against closed forms.

use frame::{Alignment, Shutter, Truth};
use glam::{DQuat, DVec2, DVec3};
use tests::half_plane::half_plane;
use tests::shapes::*;
use tests::unwatched;
use tracer::{Key, Mesh, Motion, RenderSettings, Scene, trace_truth};

use crate::moving_shapes::{
    DISTANCE, HEIGHT, SPEED, WIDTH, expect_coverage, pixel_corner, render_truth, truth_settings,
};

/// Directions of motion, in degrees.
const ANGLES: [f64; 4] = [0.0, 30.0, 45.0, 90.0];
/// Makes a white mesh on black in straight motion, turned by `angle`; at `t = 0` it passes `at`.
fn moving_scene(mesh: Mesh, at: DVec2, angle: f64, velocity: DVec2) -> Scene {
    let mut scene = empty_scene("coverage");
    let place = |time: f64| {
        let place = at + time * velocity;
        Key {
            time,
            translation: DVec3::new(place.x, place.y, -DISTANCE),
            orientation: DQuat::from_rotation_z(angle),
            ..Key::REST
        }
    };
    let motion = Motion {
        keys: vec![place(-1.0), place(1.0)],
        ..Motion::default()
    };
    add(&mut scene, mesh, glowing(1.0), motion);
    scene
}

/// Integrates `value` over a pixel, by the midpoint rule on `side` squared points.
fn mean_over_pixel(pixel: DVec2, side: u32, value: impl Fn(DVec2) -> f64) -> f64 {
    let at = |index: u32| (f64::from(index) + 0.5) / f64::from(side);
    let sum: f64 = (0..side * side)
        .map(|index| value(pixel + DVec2::new(at(index % side), at(index / side))))
        .sum();
    sum / f64::from(side * side)
}

/// Returns the length of the common part of two intervals.
fn overlap(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[1].min(b[1]) - a[0].max(b[0])).max(0.0)
}

/// Returns every shutter with every angle, in radians.
fn cases() -> impl Iterator<Item = (Alignment, f64)> {
    Alignment::ALL
        .into_iter()
        .flat_map(|alignment| ANGLES.map(|degrees| (alignment, degrees.to_radians())))
}

/// Renders a truth, and compares its coverage with the exact one and with its colour.
fn expect_rendered(
    what: &str,
    scene: &Scene,
    alignment: Alignment,
    exact: impl Fn(DVec2, Shutter) -> f64,
) {
    let truth = render_truth(scene, alignment);
    expect_coverage(&format!("{what}, {alignment}"), &truth, |x, y| {
        exact(pixel_corner(x, y), truth.shutter)
    });
    expect_same_as_color(&truth);
}

/// Compares coverage with colour: the object emits 1 on black.
fn expect_same_as_color(truth: &Truth) {
    let mean = truth.mean();
    for (pixel, color) in mean.color.pixels.iter().enumerate() {
        assert!((mean.coverage[1].pixels[pixel] - color[0]).abs() < 1e-6);
        assert!((mean.coverage[0].pixels[pixel] + color[0] - 1.0).abs() < 1e-6);
    }
    assert_eq!(truth.motion, mean.coverage[1], "only the object moves");
}

#[test]
fn a_half_plane_covers_what_the_polynomial_says() {
    for (alignment, angle) in cases() {
        let normal = DVec2::from_angle(angle);
        // The edge lies 2.3 pixels ahead of the centre; the other edges are far outside.
        let scene = moving_scene(
            rectangle(400.0, 400.0),
            (2.3 - 200.0) * normal,
            angle,
            SPEED * normal,
        );
        expect_rendered(
            &format!("half-plane at {angle}"),
            &scene,
            alignment,
            |pixel, shutter| half_plane(pixel, normal, 2.3, SPEED, shutter),
        );
    }
}

#[test]
fn a_slab_covers_the_difference_of_two_half_planes() {
    for (alignment, angle) in cases() {
        let normal = DVec2::from_angle(angle);
        // Motion is not along the normal, and the slab is thinner than its smear.
        let velocity = SPEED * DVec2::from_angle(angle + 0.35);
        let (behind, ahead) = (-1.2, 1.9);
        let middle = 0.5 * (behind + ahead) * normal;
        let scene = moving_scene(
            rectangle((ahead - behind) as f32, 400.0),
            middle,
            angle,
            velocity,
        );
        let speed = velocity.dot(normal);
        // The slab's width is rounded to f32.
        expect_rendered(
            &format!("slab at {angle}"),
            &scene,
            alignment,
            |pixel, shutter| {
                half_plane(pixel, normal, ahead, speed, shutter)
                    - half_plane(pixel, normal, behind, speed, shutter)
            },
        );
    }
}

#[test]
fn several_keys_inside_one_shutter_cover_the_sum_of_their_parts() {
    // Forward, back at a higher speed, and forward again: keys inside the shutter of every alignment.
    let keys = [
        (-0.9, 0.0),
        (-0.4, 6.0),
        (-0.2, 1.0),
        (0.1, 3.0),
        (0.3, -2.0),
        (0.9, 5.0),
    ];
    for (alignment, angle) in cases() {
        let normal = DVec2::from_angle(angle);
        let mut scene = moving_scene(rectangle(400.0, 400.0), DVec2::ZERO, angle, DVec2::ZERO);
        let key = |(time, along): (f64, f64)| {
            let place = (along - 200.0) * normal;
            Key {
                time,
                translation: DVec3::new(place.x, place.y, -DISTANCE),
                orientation: DQuat::from_rotation_z(angle),
                ..Key::REST
            }
        };
        scene.objects[0].motion.keys = keys.map(key).to_vec();
        expect_rendered("reversals", &scene, alignment, |pixel, shutter| {
            keys.windows(2)
                .map(|pair| {
                    let [(from, start), (to, end)] = [pair[0], pair[1]];
                    let span = [from.max(shutter.open), to.min(shutter.close)];
                    if span[0] >= span[1] {
                        return 0.0;
                    }
                    let speed = (end - start) / (to - from);
                    let part = Shutter::new(span[0], span[1]).expect("not empty");
                    let weight = part.exposure() / shutter.exposure();
                    weight * half_plane(pixel, normal, start - speed * from, speed, part)
                })
                .sum()
        });
    }
}

#[test]
fn a_disc_covers_its_chord_s_share_of_the_shutter() {
    let radius = 4.4;
    for (alignment, angle) in cases() {
        let along = DVec2::from_angle(angle);
        let centre = DVec2::new(0.7, -0.3);
        let scene = moving_scene(disc(radius as f32, 2048), centre, 0.0, SPEED * along);
        expect_rendered(
            &format!("disc at {angle}"),
            &scene,
            alignment,
            |pixel, shutter| {
                let share = |point: DVec2| {
                    let place = point - centre;
                    let across = place.dot(along.perp());
                    let half_chord = (radius * radius - across * across).max(0.0).sqrt();
                    let inside = [place.dot(along) - half_chord, place.dot(along) + half_chord];
                    let travel = [SPEED * shutter.open, SPEED * shutter.close];
                    overlap(inside, travel) / (SPEED * shutter.exposure())
                };
                // The chord's end has a root: the error is (1/128)^1.5 x 0.2 x sqrt(2 radius) / travel = 5e-5 in the
                // pixels that it crosses. Standard errors are above 2e-4.
                mean_over_pixel(pixel, 128, share)
            },
        );
    }
}

#[test]
fn a_rotating_bar_covers_its_sector_of_the_annulus() {
    let (inner, outer, half_width) = (2.0, 7.5, 0.8);
    let rate = 1.9;
    for alignment in Alignment::ALL {
        let mut scene = empty_scene("bar");
        let mut bar = rectangle((outer - inner) as f32, 2.0 * half_width as f32);
        for position in &mut bar.positions {
            position.x += 0.5 * (inner + outer) as f32;
        }
        let centre = DVec3::new(0.0, 0.0, -DISTANCE);
        add(&mut scene, bar, glowing(1.0), spin(centre, DVec3::Z, rate));
        expect_rendered("bar", &scene, alignment, |pixel, shutter| {
            let swept = [rate * shutter.open, rate * shutter.close];
            let share = |point: DVec2| {
                let distance = point.length();
                if !(inner..outer + half_width).contains(&distance) {
                    return 0.0;
                }
                let nearest = (outer / distance).min(1.0).acos();
                let farthest = (half_width / distance)
                    .min(1.0)
                    .asin()
                    .min((inner / distance).min(1.0).acos());
                // The bar's angles that contain the point lie on both sides of the point's own angle.
                let sides = if farthest <= nearest {
                    0.0
                } else {
                    overlap(
                        swept,
                        [point.to_angle() + nearest, point.to_angle() + farthest],
                    ) + overlap(
                        swept,
                        [point.to_angle() - farthest, point.to_angle() - nearest],
                    )
                };
                sides / (swept[1] - swept[0])
            };
            // The share jumps by up to 0.1 across the bar's end: 1e-4 by the midpoint rule. Standard errors are 1e-3.
            mean_over_pixel(pixel, 128, share)
        });
    }
}

#[test]
fn noise_falls_as_stratification_predicts() {
    let normal = DVec2::from_angle(30f64.to_radians());
    let scene = moving_scene(
        rectangle(400.0, 400.0),
        (2.3 - 200.0) * normal,
        30f64.to_radians(),
        SPEED * normal,
    );
    let rms = |samples: u32| {
        let settings = RenderSettings {
            samples_per_pixel: 2 * samples,
            replicates: 2,
            ..truth_settings()
        };
        let truth = trace_truth(&scene, &settings, Alignment::Trailing, &unwatched)
            .expect("settings are allowed");
        let mut squares = Vec::new();
        for y in 0..HEIGHT {
            for x in 0..WIDTH {
                let exact = half_plane(pixel_corner(x, y), normal, 2.3, SPEED, truth.shutter);
                if exact > 0.0 && exact < 1.0 {
                    squares.extend(truth.halves.iter().map(|half| {
                        (f64::from(half.coverage[1].at(x, y).to_owned()) - exact).powi(2)
                    }));
                }
            }
        }
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    };
    let slope = (rms(1024) / rms(16)).log2() / (1024.0_f64 / 16.0).log2();
    // Random samples fall with -0.5; Owen-scrambled points in three dimensions fall with about -0.75.
    assert!(slope > -1.0 && slope < -0.6, "slope is {slope}");
}
