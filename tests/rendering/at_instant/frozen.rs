//! Shading at the instant: the frozen colour of a truth.

use std::f64::consts::PI;

use frame::Alignment;
use glam::{DQuat, DVec3, Vec3};
use scene::{Background, Finish, Key};

use super::{DISTANCE, EXPOSURE, HEIGHT, SPEED, WIDTH, panel_over_wall, render};
use crate::renders::*;

#[test]
fn the_frozen_truth_of_a_still_scene_equals_its_truth() {
    let mut scene = panel_over_wall(2.0, 0.0, 10.0);
    scene.objects[1].motion = placed(DVec3::new(0.0, 0.0, -DISTANCE));
    scene.materials[0] = diffuse(0.7);
    scene.sun = sun(DVec3::new(0.3, 0.5, 1.0), 1.0, 0.05);
    let truth = render(&scene, Alignment::Trailing, 512);
    for (half, known) in truth.halves.iter().zip(&truth.at_instant) {
        assert_eq!(half.color, known.frozen(&half.color));
        assert!(known.unknowable.pixels.iter().all(|share| *share == 0.0));
        assert!(known.placed.pixels.iter().all(|share| *share == 1.0));
        // Only the sample's own position in the pixel would remain.
        let mut places = known.offset.pixels.iter().chain(&known.spread.pixels);
        assert!(places.all(|place| *place == [0.0; 2]));
    }
}

#[test]
fn a_closed_mesh_does_not_hide_its_own_near_side() {
    const SAMPLES: u32 = 256;
    for (radius, offset) in [(1e-3, 0.0), (4.0, 0.0), (4.0, 1e4)] {
        let mut scene = empty_scene("sphere");
        let eye = DVec3::splat(offset);
        scene.camera.motion = placed(eye);
        zoom_slightly(&mut scene);
        let at = placed(eye - DVec3::Z * 1.5 * radius);
        add(&mut scene, icosphere(radius as f32, 5), diffuse(0.5), at);
        // An object moves behind the camera, and the camera zooms slightly, so everything is shaded
        // again.
        let speck = drift(eye + 50.0 * radius * DVec3::Z, 1e-3 * DVec3::X);
        add(&mut scene, rectangle(1e-4, 1e-4), glowing(1.0), speck);
        scene.background = Background::Constant(Vec3::ONE);
        let truth = render(&scene, Alignment::Centred, SAMPLES);
        let known = truth.at_instant_mean();
        let what = format!("{radius} m at {offset} m");
        let live = truth.mean().color;
        let frozen = truth.frozen_mean();
        let pairs = frozen.pixels.iter().zip(&live.pixels);
        let differences = pairs.map(|(frozen, live)| f64::from((frozen[0] - live[0]).abs()));
        let mean = differences.sum::<f64>() / f64::from(WIDTH * HEIGHT);
        // Both pictures take the same random numbers at the same places. Rounding may flip one
        // sample in a thousand, by half of the sky's light.
        assert!(mean < 0.5e-3, "shaded again, {what} differ by {mean}");
        let seen = known.placed.pixels.iter().all(|placed| *placed == 1.0);
        assert!(seen, "everything is in front of the camera");
        let unknown = known.unknowable.pixels.iter().filter(|share| **share > 0.0);
        assert_eq!(unknown.count(), 0, "pixels of a still sphere of {what}");
    }
}

/// Makes a camera that flies over a mirror in a still world: each point of the floor mirrors
/// another height of the sky at another time.
#[test]
fn a_frozen_mirror_shows_the_view_of_the_instant_s_camera() {
    let mut scene = empty_scene("mirror");
    let mut mirror = diffuse(1.0);
    mirror.finish = Finish::Conductor { roughness: 0.0 };
    let floor = facing_up(DVec3::ZERO);
    add(&mut scene, rectangle(500.0, 500.0), mirror, floor);
    scene.background = heights(0.0, 0.0, 1.0);
    // The camera looks down at a slope of 1 to 2, on a spot so small that all pixels see the same.
    let view = DVec3::new(0.0, -1.0, -2.0);
    scene.camera.motion = through([-1.0, 1.0].map(|time| Key {
        time,
        translation: DVec3::new(0.0, 2.0, -3.0 * time),
        orientation: DQuat::from_rotation_arc(DVec3::NEG_Z, view.normalize()),
        ..Key::REST
    }));
    scene.camera.vertical_fov = vec![(0.0, 1e-4)];
    let truth = render(&scene, Alignment::Trailing, 256);
    // The mirrored ray rises as steeply as the view ray falls, at all times that the camera sees
    // the point.
    let live = 0.2_f64.sqrt();
    // At time t the camera sees the floor 4 + 3 t metres ahead of its position at the instant.
    let steps = 1000;
    let time = |step| -EXPOSURE * (f64::from(step) + 0.5) / f64::from(steps);
    let seen = (0..steps).map(|step| 2.0 / (4.0 + 3.0 * time(step)).hypot(2.0));
    let frozen = seen.sum::<f64>() / f64::from(steps);
    assert!((live - frozen).abs() > 0.05, "they can be told apart");
    // 384 pixels of 256 stratified samples; a quarter of these is shaded again.
    expect_near("live", mean_of(&truth.mean().color), live, 1e-4);
    let actual = mean_of(&truth.frozen_mean());
    expect_near("frozen", actual, frozen, 1e-3);
}

#[test]
fn a_moving_shadow_stands_still_in_the_frozen_truth() {
    let mut scene = empty_scene("shadow");
    let wall = placed(DVec3::new(0.0, 0.0, -DISTANCE));
    add(&mut scene, rectangle(200.0, 200.0), diffuse(0.8), wall);
    // A blind between the wall and the sun, out of the camera's sight.
    let blind = drift(DVec3::new(0.0, 16.0, -DISTANCE + 10.0), DVec3::X * SPEED);
    add(&mut scene, rectangle(10.0, 6.0), diffuse(0.5), blind);
    scene.sun = sun(DVec3::new(0.0, 1.6, 1.0), 2.0, 0.0);
    // Nothing moves on screen yet, so that no score looks at frozen shading.
    let unseen = render(&scene, Alignment::Trailing, 64).at_instant_mean();
    assert!(unseen.shift.pixels.iter().all(|shift| *shift == [0.0; 3]));
    zoom_slightly(&mut scene);
    let truth = render(&scene, Alignment::Trailing, 1024);
    let frame = render_frame(&scene, &settings([WIDTH, HEIGHT], 256));
    let known = truth.at_instant_mean();
    let lit = 0.8 / PI * 2.0 / f64::hypot(1.6, 1.0);
    let [mean, frozen] = [truth.mean().color, truth.frozen_mean()];
    // The shadow moves across columns. The mean of a column has less noise than a pixel.
    let [mut off, mut moved] = [0.0_f64; 2];
    for x in 0..WIDTH {
        let column = |of: &frame::Image| {
            (0..HEIGHT).map(|y| f64::from(of.at(x, y)[0])).sum::<f64>() / f64::from(HEIGHT) / lit
        };
        off = off.max((column(&frozen) - column(&frame.color)).abs());
        moved = moved.max((column(&mean) - column(&frame.color)).abs());
    }
    // Both take 256 samples per pixel of the shadow's border: a quarter of the truth's 1024 is
    // shaded again.
    assert!(off < 0.03, "frozen and frame differ by {off}");
    assert!(moved > 0.25, "the shadow moves");
    // The wall is always visible.
    assert!(known.unknowable.pixels.iter().all(|share| *share == 0.0));
}

#[test]
fn a_turning_sphere_keeps_the_shading_of_the_instant() {
    let rate = 2.0;
    let light = DVec3::new(0.8, 0.0, 0.6);
    let mut scene = empty_scene("sphere");
    let place = DVec3::new(0.0, 0.0, -DISTANCE - 50.0);
    let turning = spin(place, DVec3::Y, rate);
    add(&mut scene, icosphere(50.0, 6), diffuse(0.6), turning);
    scene.sun = sun(light, PI as f32, 0.0);
    // The view is so narrow that all pixels see nearly one normal: within 0.02 of +Z.
    scene.camera.vertical_fov = vec![(0.0, 0.1)];
    let truth = render(&scene, Alignment::Trailing, 256);
    // The mean over the picture equals the centre except for second-order terms. A point seen there
    // at time t is, at the instant, where a turn by -rate t has brought it.
    let actual = mean_of(&truth.frozen_mean());
    let steps = 10_000;
    let shaded = (0..steps).map(|step| {
        let turned = rate * EXPOSURE * (f64::from(step) + 0.5) / f64::from(steps);
        let normal = DVec3::new(turned.sin(), 0.0, turned.cos());
        normal.dot(light).max(0.0)
    });
    let expected = 0.6 * shaded.sum::<f64>() / f64::from(steps);
    // The square of 0.02, and interpolated normals.
    expect_near("frozen", actual, expected, 0.002);
    let live = mean_of(&truth.mean().color);
    expect_near("live", live, 0.6 * light.z, 0.002);
}
