//! Shading at the instant: the frozen colour of a truth.

use std::f64::consts::{FRAC_PI_2, PI};

use frame::Alignment;
use glam::{DQuat, DVec3, Vec3};
use tests::shapes::*;
use tests::unwatched;
use tracer::{Background, Finish, Key, Material, Motion, RenderSettings, Sun, trace_frame};

use super::{
    DISTANCE, EXPOSURE, HEIGHT, SPEED, WIDTH, panel_over_wall, render_truth, render_truth_with,
};

#[test]
fn the_frozen_truth_of_a_still_scene_equals_its_truth() {
    let mut scene = panel_over_wall(2.0, 0.0, 10.0);
    scene.objects[1].motion = placed(DVec3::new(0.0, 0.0, -DISTANCE));
    scene.materials[0] = diffuse(0.7);
    scene.sun = Some(Sun {
        direction: DVec3::new(0.3, 0.5, 1.0).normalize(),
        irradiance: Vec3::ONE,
        angular_radius: 0.05,
    });
    // Quiet pixels get an eighth of the mean.
    let truth = render_truth_with(&scene, Alignment::Trailing, 8 * 1024);
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
        // Something moves behind the camera, so that everything is shaded again.
        let speck = eye + DVec3::new(0.0, 0.0, 50.0 * radius);
        add(
            &mut scene,
            rectangle(1e-4, 1e-4),
            glowing(1.0),
            drift(speck, 1e-3 * DVec3::X),
        );
        scene.background = Background::Constant(Vec3::ONE);
        let truth = render_truth(&scene, Alignment::Centred);
        let known = truth.at_instant_mean();
        let difference = known
            .frozen
            .pixels
            .iter()
            .zip(&truth.mean().color.pixels)
            .map(|(frozen, live)| f64::from((frozen[0] - live[0]).abs()))
            .fold(0.0, f64::max);
        // The same random numbers from the same places: rounding may flip one sample in a thousand.
        assert!(
            difference < 2e-3,
            "shaded again, {radius} m at {offset} m differ by {difference}"
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
    let truth = render_truth(&panel_over_wall(2.0, 0.0, 10.0), Alignment::Centred);
    for (half, known) in truth.halves.iter().zip(&truth.at_instant) {
        assert_eq!(half.color, known.frozen);
    }
}

/// Makes a camera that flies over a mirror in a still world: each point of the floor mirrors another height of the sky
/// at another time.
#[test]
fn a_frozen_mirror_shows_the_view_of_the_instant_s_camera() {
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
    let view = DVec3::new(0.0, -1.0, -2.0);
    let at = |time: f64| Key {
        time,
        translation: DVec3::new(0.0, 2.0, -3.0 * time),
        orientation: DQuat::from_rotation_arc(DVec3::NEG_Z, view.normalize()),
        ..Key::REST
    };
    scene.camera.motion = Motion {
        keys: vec![at(-1.0), at(1.0)],
        ..Motion::default()
    };
    scene.camera.vertical_fov = vec![(0.0, 1e-4)];
    let truth = render_truth(&scene, Alignment::Trailing);
    // The mirrored ray rises as steeply as the view ray falls, at all times that the camera sees the point.
    let live = 0.2_f64.sqrt();
    // At time t the camera sees the floor 4 + 3 t metres ahead of its place at the instant.
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
    // 384 pixels of 1024 stratified samples, a quarter of which is shaded again.
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
    let truth = render_truth_with(&scene, Alignment::Trailing, 4096);
    let settings = RenderSettings {
        width: WIDTH,
        height: HEIGHT,
        samples_per_pixel: 1024,
        ..RenderSettings::default()
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
    // Both take 1024 samples per pixel of the shadow's border: a quarter of the truth's 4096 is shaded again. Light
    // between blind and wall adds a little noise.
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
fn a_turning_sphere_keeps_the_shading_of_the_instant() {
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
    // Few of the samples go to the centre, which is less noisy than the rest.
    let truth = render_truth_with(&scene, Alignment::Trailing, 8192);
    let frozen = truth.at_instant_mean().frozen;
    // The mean of the four pixels around the centre equals that of the centre except for second-order terms. A point
    // seen there at time t stands at the instant where a turn by -rate t has brought it.
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
