//! Thin glass.

use glam::{DQuat, DVec3, Vec3};
use tests::shapes::*;
use tests::statistics::{estimate_pixels, expect_pooled_agreement};
use tracer::{Background, Key, Motion};

use super::{assert_near, glass, hang};
use crate::small_truths::render_truth;

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
        for pixel in &render_truth(&scene, 16).mean().color.pixels {
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
    scene.background = Background::Gradient {
        ground: Vec3::ZERO,
        horizon: Vec3::ZERO,
        zenith: Vec3::ONE,
    };
    let tilted = Motion::still(Key {
        translation: DVec3::new(0.0, 0.0, -4.0),
        orientation: DQuat::from_rotation_x(-0.25 * std::f64::consts::PI),
        ..Key::REST
    });
    add(
        &mut scene,
        rectangle(1.0, 1.0),
        glass(1.5, Vec3::ONE),
        tilted,
    );
    scene.camera.vertical_fov = vec![(0.0, 0.002)];
    // Snell: sin 45 / 1.5.
    let cosine = 0.5_f64.sqrt();
    let inside = (1.0 - 0.5 / 2.25_f64).sqrt();
    let across = (cosine - 1.5 * inside) / (cosine + 1.5 * inside);
    let along = (1.5 * cosine - inside) / (1.5 * cosine + inside);
    let r = 0.5 * (across * across + along * along);
    let expected = 2.0 * r / (1.0 + r);
    let truth = render_truth(&scene, 16);
    for pixel in &truth.mean().color.pixels {
        // The view is 0.002 radians high, and the horizon behind the pane shows with 0.001.
        assert!(
            (f64::from(pixel[0]) - expected).abs() < 2e-3,
            "{pixel:?} {expected}"
        );
    }
}

#[test]
fn clear_glass_and_white_things_under_a_white_sky_cannot_be_seen() {
    let mut scene = empty_scene("furnace");
    scene.background = Background::Constant(Vec3::ONE);
    let away = |x: f64| DVec3::new(x, 0.0, -4.0);
    add(
        &mut scene,
        cuboid(Vec3::ONE),
        glass(1.5, Vec3::ONE),
        spin(away(-1.0), DVec3::Y, 2.0),
    );
    add(
        &mut scene,
        icosphere(0.4, 1),
        diffuse(1.0),
        spin(away(-1.0), DVec3::Z, 3.0),
    );
    let mut dirty = glass(1.9, Vec3::ONE);
    dirty.opacity = 0.3;
    dirty.diffuse = Vec3::ONE;
    add(
        &mut scene,
        cuboid(Vec3::new(0.3, 3.0, 0.3)),
        dirty,
        drift(away(0.8), DVec3::X),
    );
    let truth = render_truth(&scene, 64);
    assert!(truth.mean().coverage[2].pixels.iter().any(|own| *own > 0.1));
    expect_pooled_agreement("furnace", &estimate_pixels(&truth, |_, _| 1.0));
}
