//! Translucent surfaces against known answers; light through them: shadows, and two paths to the
//! same light.

mod buffers;
mod panes;

use glam::{DVec3, Vec3};
use scene::{Background, Material, Scene, Translucency};

use crate::renders::{self, *};

/// Makes an unlit film of an opacity, which lets `filter` of the rest pass.
pub fn film(radiance: Vec3, opacity: f32, filter: Vec3) -> Material {
    Material {
        emission: radiance,
        opacity,
        translucency: Some(Translucency {
            filter,
            ..Translucency::CLEAR
        }),
        ..glowing(0.0)
    }
}

/// Makes clean glass of this index, which absorbs `1 - filter` of the light inside it.
pub fn glass(index: f32, filter: Vec3) -> Material {
    Material {
        opacity: 0.0,
        translucency: Some(Translucency {
            filter,
            glass: Some(index),
            ..Translucency::CLEAR
        }),
        ..glowing(0.0)
    }
}

/// Hangs a still pane across the view, larger than the picture.
fn hang(scene: &mut Scene, material: Material, z: f64) -> usize {
    let at = placed(DVec3::new(0.0, 0.0, z));
    add(scene, rectangle(1000.0, 1000.0), material, at)
}

/// Fails unless all three components agree.
fn assert_near(actual: [f32; 3], expected: Vec3, tolerance: f32, what: &str) {
    let error = (Vec3::from(actual) - expected).abs().max_element();
    assert!(error <= tolerance, "{what}: {actual:?}, not {expected}");
}

/// Makes a floor of albedo 0.6, with a spot around the origin that the camera sees from below any
/// pane.
fn floor_scene(panes: &[Material]) -> Scene {
    let mut scene = renders::floor_scene(diffuse(0.6));
    for (index, pane) in panes.iter().enumerate() {
        let height = facing_up(DVec3::new(0.0, 3.0 + index as f64, 0.0));
        add(&mut scene, rectangle(2000.0, 2000.0), pane.clone(), height);
    }
    scene
}

fn mean(scene: &Scene, samples_per_pixel: u32) -> Vec3 {
    let pixels = render_small_truth(scene, samples_per_pixel).mean();
    let pixels = pixels.color.pixels;
    pixels.iter().map(|pixel| Vec3::from(*pixel)).sum::<Vec3>() / pixels.len() as f32
}

#[test]
fn the_shadow_of_a_film_has_its_colour() {
    let films = [
        film(Vec3::ZERO, 0.25, Vec3::new(1.0, 0.5, 0.2)),
        film(Vec3::ZERO, 0.6, Vec3::new(0.8, 1.0, 0.4)),
    ];
    for count in 0..=2 {
        let mut scene = floor_scene(&films[..count]);
        scene.sun = sun(DVec3::new(0.6, 0.8, 0.0), 2.0, 0.0);
        let passed = [
            Vec3::ONE,
            0.75 * Vec3::new(1.0, 0.5, 0.2),
            0.75 * 0.4 * Vec3::new(0.8, 0.5, 0.08),
        ][count];
        let expected = 0.6 * 2.0 * 0.8 / std::f32::consts::PI * passed;
        let actual = mean(&scene, 16);
        assert_near(actual.to_array(), expected, 1e-5, "shadow");
    }
}

#[test]
fn the_shadow_of_glass_is_what_fresnel_lets_pass() {
    let mut scene = floor_scene(&[glass(1.5, Vec3::ONE)]);
    scene.sun = sun(DVec3::Y, 2.0, 0.0);
    // Each side reflects 4 % straight on. Light that the floor sends up comes back by the series of
    // floor and pane, so the floor is black for the reflection: only direct light counts here.
    scene.materials[0] = diffuse(0.01);
    let direct = 0.01 * 2.0 / std::f32::consts::PI * (0.96 / 1.04);
    let actual = mean(&scene, 256);
    // The pane sends back less than a quarter of what 1 % of the floor scatters.
    let range = direct - 1e-7..1.0025 * direct;
    assert!(range.contains(&actual.x), "{actual} {direct}");
}

/// An image of a sky bright above is sampled as a light, and so is one of a sky bright below. Their
/// sum is even, so it is not.
#[test]
fn light_that_is_sampled_and_light_that_is_met_agree_behind_panes() {
    let panes = [
        film(Vec3::ZERO, 0.3, Vec3::new(0.9, 0.5, 0.2)),
        glass(1.5, Vec3::new(1.0, 0.8, 0.6)),
    ];
    let render = |sky, samples| {
        let mut scene = floor_scene(&panes);
        scene.background = sky;
        mean(&scene, samples)
    };
    let [above, below] = [heights(0.0, 0.0, 1.0), heights(1.0, 1.0, 0.0)];
    let sum = render(image_of(&above), 512) + render(image_of(&below), 512);
    let whole = render(Background::Constant(Vec3::ONE), 512);
    // 144 pixels of 512 stratified samples: 1e-4 (measured).
    let error = (sum - whole).abs().max_element();
    assert!(error < 1e-3, "{sum} {whole}");
    assert!(whole.x > 0.3 && whole.z < 0.5 * whole.x, "{whole}");
}
