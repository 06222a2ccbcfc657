//! Light through translucent surfaces: shadows, and two ways to the same light.

use frame::Truth;
use glam::{DQuat, DVec3, Vec3};
use tests::shapes::*;
use tracer::{Background, Key, Material, Motion, Scene, Sun};

use super::{assert_near, film, glass};
use crate::small_truths::render_truth;

/// Returns the pose of a rectangle that faces upwards.
fn facing_up(at: DVec3) -> Motion {
    Motion::still(Key {
        translation: at,
        orientation: DQuat::from_rotation_x(-0.5 * std::f64::consts::PI),
        ..Key::REST
    })
}

/// Makes a floor of albedo 0.6, of which the camera sees a spot around the origin from below any pane.
fn floor_scene(panes: &[Material]) -> Scene {
    let mut scene = empty_scene("floor");
    add(
        &mut scene,
        rectangle(100.0, 100.0),
        diffuse(0.6),
        facing_up(DVec3::ZERO),
    );
    for (index, pane) in panes.iter().enumerate() {
        let height = DVec3::new(0.0, 3.0 + index as f64, 0.0);
        add(
            &mut scene,
            rectangle(2000.0, 2000.0),
            pane.clone(),
            facing_up(height),
        );
    }
    look_at_a_spot(&mut scene);
    scene
}

fn mean(truth: &Truth) -> Vec3 {
    let color = truth.mean().color;
    let sum: Vec3 = color.pixels.iter().map(|pixel| Vec3::from(*pixel)).sum();
    sum / color.pixels.len() as f32
}

#[test]
fn the_shadow_of_a_film_has_its_colour() {
    let films = [
        film(Vec3::ZERO, 0.25, Vec3::new(1.0, 0.5, 0.2)),
        film(Vec3::ZERO, 0.6, Vec3::new(0.8, 1.0, 0.4)),
    ];
    for count in 0..=2 {
        let mut scene = floor_scene(&films[..count]);
        scene.sun = Some(Sun {
            direction: DVec3::new(0.6, 0.8, 0.0),
            irradiance: Vec3::splat(2.0),
            angular_radius: 0.0,
        });
        let passed = [
            Vec3::ONE,
            0.75 * Vec3::new(1.0, 0.5, 0.2),
            0.75 * 0.4 * Vec3::new(0.8, 0.5, 0.08),
        ][count];
        let expected = 0.6 * 2.0 * 0.8 / std::f32::consts::PI * passed;
        let found = mean(&render_truth(&scene, 16));
        assert_near(found.to_array(), expected, 1e-5, "shadow");
    }
}

#[test]
fn the_shadow_of_glass_is_what_fresnel_lets_pass() {
    let mut scene = floor_scene(&[glass(1.5, Vec3::ONE)]);
    scene.sun = Some(Sun {
        direction: DVec3::Y,
        irradiance: Vec3::splat(2.0),
        angular_radius: 0.0,
    });
    // Each side reflects 4 % straight on. What the floor sends up comes back by the series of floor and pane, so the floor
    // is black for the reflection: only direct light counts here.
    scene.materials[0] = diffuse(0.01);
    let direct = 0.01 * 2.0 / std::f32::consts::PI * (0.96 / 1.04);
    let found = mean(&render_truth(&scene, 256));
    // The pane sends back less than a quarter of what 1 % of the floor scatters.
    assert!(
        found.x >= direct - 1e-7 && found.x < 1.0025 * direct,
        "{found} {direct}"
    );
}

/// A sky that is bright above is sampled as a light, and so is one bright below. Their sum is even, so it is not.
#[test]
fn light_that_is_sampled_and_light_that_is_met_agree_behind_panes() {
    let heights = |ground: f32, horizon: f32, zenith: f32| Background::Gradient {
        ground: Vec3::splat(ground),
        horizon: Vec3::splat(horizon),
        zenith: Vec3::splat(zenith),
    };
    let panes = [
        film(Vec3::ZERO, 0.3, Vec3::new(0.9, 0.5, 0.2)),
        glass(1.5, Vec3::new(1.0, 0.8, 0.6)),
    ];
    let render = |sky, samples| {
        let mut scene = floor_scene(&panes);
        scene.background = sky;
        mean(&render_truth(&scene, samples))
    };
    let sum = render(heights(0.0, 0.0, 1.0), 2048) + render(heights(1.0, 1.0, 0.0), 2048);
    let whole = render(Background::Constant(Vec3::ONE), 2048);
    // 144 pixels of 2048 samples whose deviation is below 1: four deviations of the difference.
    let error = (sum - whole).abs().max_element();
    assert!(error < 0.008, "{sum} {whole}");
    assert!(whole.x > 0.3 && whole.z < 0.5 * whole.x, "{whole}");
}

/// A lamp of translucent paint, sampled as a light, and the same lamp met by chance: a mirror's rays are never sampled.
#[test]
fn a_translucent_lamp_lights_in_proportion_to_its_opacity() {
    let lit_by = |lamp: Material| {
        let mut scene = floor_scene(&[]);
        let above = facing_up(DVec3::new(0.0, 1.0, 0.0));
        add(&mut scene, rectangle(0.5, 0.5), lamp, above);
        mean(&render_truth(&scene, 1024)).x
    };
    let opaque = lit_by(glowing(8.0));
    let found = lit_by(film(Vec3::splat(8.0), 0.25, Vec3::ONE));
    // Both have 147,456 samples of about 10 % deviation.
    assert!((found / opaque - 0.25).abs() < 1e-3, "{found} of {opaque}");
}
