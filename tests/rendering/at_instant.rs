//! What only a tracer can tell: how the things that the shutter sees were at the frame's instant.
//!
//! The camera sees one metre as one pixel at the panels' distance, the image's centre at the origin.

use std::f64::consts::{FRAC_PI_2, PI};

use frame::{Alignment, AtInstant, Truth};
use glam::{DQuat, DVec3, Vec3};
use tests::shapes::*;
use tests::unwatched;
use tracer::{
    Background, Finish, FrameSettings, Key, Material, Motion, Scene, Sun, TruthSettings, Turn,
    trace_frame, trace_truth,
};

const WIDTH: u32 = 32;
const HEIGHT: u32 = 12;
/// At a vertical field of view of 90 degrees half the height in pixels is the focal length.
const DISTANCE: f64 = 0.5 * HEIGHT as f64;
/// Pixels per frame, and frames.
const SPEED: f64 = 12.0;
const EXPOSURE: f64 = 0.75;
/// 1024 stratified samples of a step err by less than 0.003 in nearly every pixel (measured for coverage: 0.0022 rms of
/// the worst); this is several times that.
const STEP_ERROR: f64 = 0.012;

fn truth(scene: &Scene, alignment: Alignment) -> Truth {
    truth_of(scene, alignment, 1024)
}

fn truth_of(scene: &Scene, alignment: Alignment, samples_per_pixel: u32) -> Truth {
    let settings = TruthSettings {
        width: WIDTH,
        height: HEIGHT,
        exposure: EXPOSURE,
        alignment,
        samples_per_pixel,
        replicates: 2,
        ..TruthSettings::default()
    };
    trace_truth(scene, &settings, &unwatched).expect("allowed")
}

/// An unlit wall so many metres behind an unlit panel whose middle passes `at` at `t = 0`, both wider than any blur is high.
fn panel_over_wall(gap: f64, at: f64, width: f32) -> Scene {
    let mut scene = empty_scene("panel");
    let place = |x: f64, z: f64| DVec3::new(x, 0.0, z);
    add(
        &mut scene,
        rectangle(200.0, 200.0),
        glowing(0.2),
        placed(place(0.0, -DISTANCE - gap)),
    );
    let motion = drift(place(at, -DISTANCE), DVec3::X * SPEED);
    add(&mut scene, rectangle(width, 100.0), glowing(0.8), motion);
    scene
}

/// Calls `check` with each column's left border, in pixels from the picture's centre, and its middle row's pixel.
fn columns(mut check: impl FnMut(f64, usize)) {
    for column in 0..WIDTH {
        let left = f64::from(column) - 0.5 * f64::from(WIDTH);
        check(left, ((HEIGHT / 2) * WIDTH + column) as usize);
    }
}

/// The mean of `value` over the columns' unit width and the shutter, by midpoints.
fn mean_over(left: f64, alignment: Alignment, value: impl Fn(f64, f64) -> f64) -> f64 {
    const STEPS: u32 = 400;
    let shutter = alignment.shutter(EXPOSURE).unwrap();
    let middle = |step: u32| (f64::from(step) + 0.5) / f64::from(STEPS);
    let places =
        (0..STEPS).flat_map(|x| (0..STEPS).map(move |t| (left + middle(x), shutter.at(middle(t)))));
    places.map(|(x, t)| value(x, t)).sum::<f64>() / f64::from(STEPS * STEPS)
}

#[test]
fn what_the_panel_uncovers_or_what_was_beyond_the_border_cannot_be_known() {
    // In the middle, and reaching over the right border; far from the wall and very near it.
    for (gap, at, half) in [(2.0, 0.0, 5.0), (2.0, 13.0, 8.0), (1e-5, 0.0, 5.0)] {
        for alignment in Alignment::ALL {
            let truth = truth(&panel_over_wall(gap, at, 2.0 * half as f32), alignment);
            let known = truth.at_instant_mean();
            columns(|left, pixel| {
                let expected = mean_over(left, alignment, |x, t| {
                    let covered = |x: f64, t: f64| (x - at - SPEED * t).abs() < half;
                    let unknown = if covered(x, t) {
                        // Where the panel's point was at the instant.
                        (x - SPEED * t).abs() > 0.5 * f64::from(WIDTH)
                    } else {
                        covered(x, 0.0)
                    };
                    f64::from(unknown)
                });
                let found = f64::from(known.unknowable.pixels[pixel]);
                assert!(
                    (found - expected).abs() < STEP_ERROR,
                    "{alignment}, panel at {at}, column {left}: {found} is unknowable, not {expected}"
                );
            });
        }
    }
}

#[test]
fn a_sliding_panel_comes_from_all_along_its_way() {
    for alignment in Alignment::ALL {
        // Wider than the picture and its way.
        let truth = truth(&panel_over_wall(2.0, 0.0, 90.0), alignment);
        let mean = truth.at_instant_mean();
        columns(|left, pixel| {
            let shutter = alignment.shutter(EXPOSURE).unwrap();
            let [open, close] = [shutter.open, shutter.close].map(|t| -SPEED * t);
            let offset = 0.5 * (open + close);
            // The mean square of a number that is uniform between two, and of the place in the pixel.
            let spread = (open * open + open * close + close * close) / 3.0 + 1.0 / 12.0;
            assert_eq!(mean.placed.pixels[pixel], 1.0);
            let [x, y] = mean.offset.pixels[pixel].map(f64::from);
            let [xx, xy, yy] = mean.spread.pixels[pixel].map(f64::from);
            // Stratified samples of smooth functions: 1/1024 of the range is several times their error.
            let error = SPEED * EXPOSURE / 1024.0;
            assert!(
                (x - offset).abs() < error && y.abs() < error,
                "{alignment} {left}: {x} {y}"
            );
            assert!(
                (xx - spread).abs() < 2.0 * SPEED * EXPOSURE * error,
                "{alignment}: {xx} {spread}"
            );
            assert!(
                xy.abs() < 0.05 && (yy - 1.0 / 12.0).abs() < error,
                "{alignment}: {xy} {yy}"
            );
        });
    }
}

#[test]
fn a_still_scene_was_always_as_it_is() {
    let mut scene = panel_over_wall(2.0, 0.0, 10.0);
    scene.objects[1].motion = placed(DVec3::new(0.0, 0.0, -DISTANCE));
    scene.materials[0] = diffuse(0.7);
    scene.sun = Some(Sun {
        direction: DVec3::new(0.3, 0.5, 1.0).normalize(),
        irradiance: Vec3::ONE,
        angular_radius: 0.05,
    });
    let truth = truth(&scene, Alignment::Trailing);
    for (half, known) in truth.halves.iter().zip(&truth.at_instant) {
        assert_eq!(half.color, known.frozen);
        assert!(
            known
                .unknowable
                .pixels
                .iter()
                .all(|unknown| *unknown == 0.0)
        );
        assert!(known.placed.pixels.iter().all(|placed| *placed == 1.0));
        for (offset, spread) in known.offset.pixels.iter().zip(&known.spread.pixels) {
            // Only the sample's own place in the pixel is left.
            assert!(offset.iter().all(|part| part.abs() < 1e-3), "{offset:?}");
            assert!((spread[0] - 1.0 / 12.0).abs() < 1e-3, "{spread:?}");
        }
    }
}

#[test]
fn a_closed_mesh_does_not_hide_its_own_near_side() {
    for (radius, offset) in [(1e-3, 0.0), (4.0, 0.0), (4.0, 1e4)] {
        let mut scene = empty_scene("sphere");
        let eye = DVec3::new(offset, offset, offset);
        scene.camera.motion = placed(eye);
        let at = eye - DVec3::Z * 1.5 * radius;
        add(
            &mut scene,
            icosphere(radius as f32, 5),
            diffuse(0.5),
            placed(at),
        );
        // Something moves behind the camera, so that shading is not taken for granted but done again.
        let speck = eye + DVec3::new(0.0, 0.0, 50.0 * radius);
        add(
            &mut scene,
            rectangle(1e-4, 1e-4),
            glowing(1.0),
            drift(speck, 1e-3 * DVec3::X),
        );
        scene.background = Background::Constant(Vec3::ONE);
        let truth = truth(&scene, Alignment::Centred);
        let known = truth.at_instant_mean();
        let again = known
            .frozen
            .pixels
            .iter()
            .zip(&truth.mean().color.pixels)
            .map(|(frozen, live)| f64::from((frozen[0] - live[0]).abs()))
            .fold(0.0, f64::max);
        // The same random numbers from the same places: rounding may turn a sample in a thousand at most.
        assert!(
            again < 2e-3,
            "shaded again, {radius} m at {offset} m differ by {again}"
        );
        let seen = known.placed.pixels.iter().all(|placed| *placed == 1.0);
        assert!(seen, "everything is in front of the camera");
        let unknown = known
            .unknowable
            .pixels
            .iter()
            .filter(|unknown| **unknown > 0.0)
            .count();
        assert_eq!(
            unknown, 0,
            "pixels of a still sphere of {radius} m at {offset} m cannot be known"
        );
    }
}

#[test]
fn an_unlit_panel_needs_no_light_of_the_instant() {
    let truth = truth(&panel_over_wall(2.0, 0.0, 10.0), Alignment::Centred);
    for (half, known) in truth.halves.iter().zip(&truth.at_instant) {
        assert_eq!(half.color, known.frozen);
    }
}

/// Nothing in the world moves; the camera flies over a mirror, in which every point of the floor shows another height of the
/// sky from elsewhere.
#[test]
fn a_mirror_is_frozen_as_the_camera_of_the_instant_saw_it() {
    let mut scene = empty_scene("mirror");
    let mirror = Material {
        finish: Finish::Conductor { roughness: 0.0 },
        ..diffuse(1.0)
    };
    let floor = Motion::still(Key {
        orientation: DQuat::from_rotation_x(-FRAC_PI_2),
        ..Key::REST
    });
    add(&mut scene, rectangle(500.0, 500.0), mirror, floor);
    scene.background = Background::Gradient {
        ground: Vec3::ZERO,
        horizon: Vec3::ZERO,
        zenith: Vec3::ONE,
    };
    // Straight down at a slope of 1 to 2, through a spot so small that all pixels see the same.
    let way = DVec3::new(0.0, -1.0, -2.0);
    let at = |time: f64| Key {
        time,
        translation: DVec3::new(0.0, 2.0, -3.0 * time),
        orientation: DQuat::from_rotation_arc(DVec3::NEG_Z, way.normalize()),
        ..Key::REST
    };
    scene.camera.motion = Motion {
        keys: vec![at(-1.0), at(1.0)],
        ..Motion::default()
    };
    scene.camera.vertical_fov = vec![(0.0, 1e-4)];
    let truth = truth(&scene, Alignment::Trailing);
    // The mirrored ray rises as steeply as the ray falls: always the same while the camera sees it.
    let live = 0.2_f64.sqrt();
    // At time t the floor is seen 4 + 3 t metres ahead of where the camera is at the instant.
    let steps = 1000;
    let frozen: f64 = (0..steps)
        .map(|step| -EXPOSURE * (f64::from(step) + 0.5) / f64::from(steps))
        .map(|time| 2.0 / (4.0 + 3.0 * time).hypot(2.0) / f64::from(steps))
        .sum();
    assert!((live - frozen).abs() > 0.05, "they can be told apart");
    let known = truth.at_instant_mean();
    let mean = |pixels: &[[f32; 3]]| {
        pixels.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>() / pixels.len() as f64
    };
    // 384 pixels of 1024 stratified samples, of which a quarter is shaded again.
    assert!((mean(&truth.mean().color.pixels) - live).abs() < 1e-4);
    let found = mean(&known.frozen.pixels);
    assert!((found - frozen).abs() < 1e-3, "{found} {frozen}");
}

#[test]
fn a_moving_shadow_stands_still_in_the_frozen_truth() {
    let mut scene = empty_scene("shadow");
    add(
        &mut scene,
        rectangle(200.0, 200.0),
        diffuse(0.8),
        placed(DVec3::new(0.0, 0.0, -DISTANCE)),
    );
    // A blind between the wall and the sun, out of the camera's sight.
    let blind = DVec3::new(0.0, 16.0, -DISTANCE + 10.0);
    add(
        &mut scene,
        rectangle(10.0, 6.0),
        diffuse(0.5),
        drift(blind, DVec3::X * SPEED),
    );
    scene.sun = Some(Sun {
        direction: DVec3::new(0.0, 1.6, 1.0).normalize(),
        irradiance: Vec3::splat(2.0),
        angular_radius: 0.0,
    });
    let truth = truth_of(&scene, Alignment::Trailing, 4096);
    let settings = FrameSettings {
        width: WIDTH,
        height: HEIGHT,
        samples_per_pixel: 1024,
        ..FrameSettings::default()
    };
    let frame = trace_frame(&scene, &settings, &unwatched).expect("allowed");
    let frozen = truth.at_instant_mean().frozen;
    let lit = 0.8 / PI * 2.0 / f64::hypot(1.6, 1.0);
    let [mut off, mut moved] = [0.0_f64; 2];
    for ((frozen, frame), truth) in frozen
        .pixels
        .iter()
        .zip(&frame.color.pixels)
        .zip(&truth.mean().color.pixels)
    {
        off = off.max(f64::from((frozen[0] - frame[0]).abs()) / lit);
        moved = moved.max(f64::from((truth[0] - frame[0]).abs()) / lit);
    }
    // Both estimate the shadow's border by 1024 samples a pixel (of the truth's 4096 a quarter is shaded again); light between blind and wall adds a little noise.
    assert!(
        off < 0.05,
        "frozen and frame differ by {off} of what is lit"
    );
    assert!(moved > 0.5, "the shadow moves");
    let unknown = truth.at_instant_mean().unknowable;
    assert!(
        unknown.pixels.iter().all(|unknown| *unknown == 0.0),
        "the wall is always seen"
    );
}

#[test]
fn a_turning_sphere_is_shaded_as_it_stood() {
    let rate = 2.0;
    let light = DVec3::new(0.8, 0.0, 0.6);
    let mut scene = empty_scene("sphere");
    // So large and near that the pixels around the centre see nearly one normal: within 0.02 of +Z.
    let place = DVec3::new(0.0, 0.0, -DISTANCE - 50.0);
    add(
        &mut scene,
        icosphere(50.0, 6),
        diffuse(0.6),
        spin(place, DVec3::Y, rate),
    );
    scene.sun = Some(Sun {
        direction: light,
        irradiance: Vec3::splat(PI as f32),
        angular_radius: 0.0,
    });
    let truth = truth(&scene, Alignment::Trailing);
    let frozen = truth.at_instant_mean().frozen;
    // The mean of the four pixels around the centre is that of the centre but for the square of that. A point seen
    // there at time t stands at the instant where a turn by -rate t has brought it.
    let centre = (HEIGHT / 2 * WIDTH + WIDTH / 2) as usize;
    let four = [
        centre,
        centre - 1,
        centre - WIDTH as usize,
        centre - WIDTH as usize - 1,
    ];
    let found: f64 = four
        .iter()
        .map(|pixel| f64::from(frozen.pixels[*pixel][0]))
        .sum::<f64>()
        / 4.0;
    let steps = 10_000;
    let shaded = (0..steps).map(|step| {
        let turned = rate * EXPOSURE * (f64::from(step) + 0.5) / f64::from(steps);
        DVec3::new(turned.sin(), 0.0, turned.cos())
            .dot(light)
            .max(0.0)
    });
    let expected = 0.6 * shaded.sum::<f64>() / f64::from(steps);
    // The square of 0.02, and interpolated normals.
    assert!((found - expected).abs() < 0.002, "{found}, not {expected}");
    let live = f64::from(truth.mean().color.pixels[centre][0]);
    assert!(
        (live - 0.6 * light.z).abs() < 0.02,
        "the truth itself is shaded as it stands: {live}"
    );
}

#[test]
fn the_other_side_of_a_sheet_cannot_be_known() {
    let mut scene = empty_scene("sheet");
    let turn = Turn {
        axis: DVec3::Y,
        angle: PI / EXPOSURE,
    };
    let at = |time| Key {
        time,
        translation: DVec3::new(0.0, 0.0, -DISTANCE),
        turn,
        ..Key::REST
    };
    let motion = Motion {
        keys: vec![
            at(0.0),
            Key {
                time: 1.0,
                ..at(0.0)
            },
        ],
        ..Motion::default()
    };
    add(&mut scene, rectangle(8.0, 8.0), glowing(1.0), motion);
    let known: AtInstant = truth(&scene, Alignment::Trailing).at_instant_mean();
    // Turned by `angle` the sheet is met by the ray through `x` this far from its axis.
    let met = |x: f64, angle: f64| DISTANCE * x / (DISTANCE * angle.cos() + x * angle.sin());
    let front = |x: f64, t: f64| {
        let angle = PI / EXPOSURE * t;
        f64::from(angle.abs() < FRAC_PI_2 && met(x, angle).abs() < 4.0)
    };
    // The axis lies between two pixels; which of them has the sheet's nearer half does not matter to their mean.
    let expected = 1.0
        - [0.0, -1.0]
            .map(|left| mean_over(left, Alignment::Trailing, front))
            .iter()
            .sum::<f64>()
            / 2.0;
    let centre = (HEIGHT / 2 * WIDTH + WIDTH / 2) as usize;
    let found = [centre, centre - 1]
        .map(|pixel| f64::from(known.unknowable.pixels[pixel]))
        .iter()
        .sum::<f64>()
        / 2.0;
    assert!(
        (found - expected).abs() < STEP_ERROR,
        "{found}, not {expected}"
    );
}

#[test]
fn what_was_behind_the_camera_has_no_place() {
    let mut scene = empty_scene("pan");
    let rate = 2.0;
    scene.camera.motion = spin(DVec3::ZERO, DVec3::Y, rate);
    let known = truth(&scene, Alignment::Trailing).at_instant_mean();
    columns(|left, pixel| {
        // The view turns left: what is seen earlier lies to the right, behind beyond a right angle.
        let expected = mean_over(left, Alignment::Trailing, |x, t| {
            f64::from((x / DISTANCE).atan() - rate * t < FRAC_PI_2)
        });
        let found = f64::from(known.placed.pixels[pixel]);
        assert!(
            (found - expected).abs() < STEP_ERROR,
            "column {left}: {found}, not {expected}"
        );
        let unknown = f64::from(known.unknowable.pixels[pixel]);
        assert!(
            unknown >= 1.0 - found - 1e-6,
            "what has no place cannot be known"
        );
    });
}
