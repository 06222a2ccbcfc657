//! Thin glass.

use std::f64::consts::FRAC_PI_4;

use glam::{DQuat, DVec3, Vec3};
use tests::shapes::*;

use super::{assert_near, glass, hang};
use crate::renders::{expect_near, mean_radiance, render_small_truth};
use crate::scenery::{fresnel, heights, turned};

#[test]
fn glass_seen_straight_on_passes_and_reflects_by_fresnel_s_equations() {
    let filter = Vec3::new(1.0, 0.7, 0.1);
    let r = (0.5_f32 / 2.5).powi(2);
    let passed = (1.0 - r).powi(2) * filter / (Vec3::ONE - r * r * filter * filter);
    let reflected = Vec3::splat(r) + r * filter * passed;
    // A lamp behind the pane, then one behind the camera.
    for (lamp, expected) in [(-8.0, passed), (8.0, reflected)] {
        let mut scene = empty_scene("straight on");
        hang(&mut scene, glass(1.5, filter), -4.0);
        hang(&mut scene, glowing(1.0), lamp);
        // 0.01 radians from the axis change nothing that 32 bits show.
        scene.camera.vertical_fov = vec![(0.0, 0.01)];
        for pixel in &render_small_truth(&scene, 16).mean().color.pixels {
            assert_near(*pixel, expected, 2e-6, "straight on");
        }
    }
    // Without a tint: 2 r / (1 + r), 7.7 % of window glass.
    assert!((reflected.x - 2.0 * r / (1.0 + r)).abs() < 1e-7);
}

#[test]
fn a_slanted_pane_mirrors_what_lies_beside_it() {
    // At 45 degrees the pane shows the sky at the zenith.
    let mut scene = empty_scene("slanted");
    scene.background = heights(0.0, 0.0, 1.0);
    let turn = DQuat::from_rotation_x(-FRAC_PI_4);
    let tilted = turned(DVec3::new(0.0, 0.0, -4.0), turn);
    let pane = glass(1.5, Vec3::ONE);
    add(&mut scene, rectangle(1.0, 1.0), pane, tilted);
    scene.camera.vertical_fov = vec![(0.0, 0.002)];
    let r = fresnel(0.5_f64.sqrt(), 1.5);
    let expected = 2.0 * r / (1.0 + r);
    // The view is 0.002 radians high, and the horizon behind the pane shows with 0.001.
    expect_near("slanted", mean_radiance(&scene, 16), expected, 2e-3);
}
