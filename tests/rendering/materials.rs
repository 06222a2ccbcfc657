//! Renders of glossy materials, against known answers.

use frame::Truth;
use glam::{DQuat, DVec3, Vec3};
use tests::shapes::*;
use tests::statistics::estimate_pixels;
use tracer::{Background, Finish, Key, Material, Motion, Scene};

use crate::small_truths::render_truth;

const GLOSSY: [Finish; 6] = [
    Finish::Conductor { roughness: 0.0 },
    Finish::Conductor { roughness: 0.3 },
    Finish::Conductor { roughness: 0.9 },
    Finish::Coated {
        roughness: 0.0,
        index: 1.5,
    },
    Finish::Coated {
        roughness: 0.2,
        index: 1.5,
    },
    Finish::Coated {
        roughness: 0.8,
        index: 2.0,
    },
];

fn glossy(finish: Finish, color: f32) -> Material {
    Material {
        finish,
        ..diffuse(color)
    }
}

/// Returns the mean of the first component over the picture.
fn mean(truth: &Truth) -> f64 {
    let pixels = &truth.mean().color.pixels;
    pixels.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>() / pixels.len() as f64
}

/// Makes a turning sphere of few facets with smooth normals under `sky`, so near that it fills the picture.
fn sphere_scene(finish: Finish, color: f32, sky: Background) -> Scene {
    let mut scene = empty_scene("sphere");
    scene.background = sky;
    let near = DVec3::new(0.0, 0.0, -1.3);
    let turning = spin(near, DVec3::Y, 2.0);
    add(
        &mut scene,
        icosphere(1.0, 1),
        glossy(finish, color),
        turning,
    );
    scene.camera.vertical_fov = vec![(0.0, 0.5)];
    scene
}

/// Makes a floor at y = 0, with one small spot seen at a slope of 1 to 2.
fn floor_scene(finish: Finish, color: f32, sky: Background) -> Scene {
    let mut scene = empty_scene("floor");
    scene.background = sky;
    let flat = Motion::still(Key {
        orientation: DQuat::from_rotation_x(-0.5 * std::f64::consts::PI),
        ..Key::REST
    });
    add(
        &mut scene,
        rectangle(100.0, 100.0),
        glossy(finish, color),
        flat,
    );
    look_at_a_spot(&mut scene);
    scene
}

fn heights(ground: f32, horizon: f32, zenith: f32) -> Background {
    Background::Gradient {
        ground: Vec3::splat(ground),
        horizon: Vec3::splat(horizon),
        zenith: Vec3::splat(zenith),
    }
}

#[test]
fn white_gloss_under_a_white_sky_cannot_be_seen() {
    for finish in GLOSSY {
        let scene = sphere_scene(finish, 1.0, Background::Constant(Vec3::ONE));
        let found = mean(&render_truth(&scene, 256));
        // The error of the albedo's table, times the few bounces between facets.
        assert!((found - 1.0).abs() < 3e-3, "{finish:?}: {found}");
    }
}

#[test]
fn a_mirror_shows_the_sky_that_it_faces() {
    // The mirrored ray rises at 1 to sqrt(5).
    let scene = floor_scene(
        Finish::Conductor { roughness: 0.0 },
        1.0,
        heights(9.0, 0.0, 1.0),
    );
    let found = estimate_pixels(&render_truth(&scene, 64), |_, _| 0.2_f64.sqrt());
    for estimate in &found {
        // The spot is 1e-4 radians high.
        assert!((estimate.value - 0.2_f64.sqrt()).abs() < 1e-4);
    }
}

#[test]
fn a_black_surface_below_a_smooth_coat_follows_fresnel_s_equations() {
    let coat = Finish::Coated {
        roughness: 0.0,
        index: 1.5,
    };
    let scene = floor_scene(coat, 0.0, Background::Constant(Vec3::ONE));
    let cosine = 0.2_f64.sqrt();
    let inside = (1.0 - 0.8 / 2.25_f64).sqrt();
    let across = (cosine - 1.5 * inside) / (cosine + 1.5 * inside);
    let along = (1.5 * cosine - inside) / (1.5 * cosine + inside);
    let expected = 0.5 * (across * across + along * along);
    let found = mean(&render_truth(&scene, 256));
    // The spot is 1e-4 radians high, where the reflectance changes by 0.4 per radian.
    assert!((found - expected).abs() < 1e-4, "{found} {expected}");
}

#[test]
fn a_metal_seen_straight_on_has_its_own_colour() {
    let mut scene = empty_scene("straight on");
    scene.background = Background::Constant(Vec3::ONE);
    let wall = placed(DVec3::new(0.0, 0.0, -4.0));
    let metal = glossy(Finish::Conductor { roughness: 0.0 }, 0.3);
    add(&mut scene, rectangle(10.0, 10.0), metal, wall);
    scene.camera.vertical_fov = vec![(0.0, 0.01)];
    let found = mean(&render_truth(&scene, 16));
    assert!((found - 0.3).abs() < 1e-6, "{found}");
}

/// A sky that is bright above is sampled as a light, and so is one bright below. Their sum is even, so it is not.
#[test]
fn sampled_light_and_light_met_by_chance_agree() {
    for finish in GLOSSY {
        let [above, below] = [heights(0.0, 0.0, 1.0), heights(1.0, 1.0, 0.0)];
        let sum: f64 = [above, below]
            .map(|sky| mean(&render_truth(&floor_scene(finish, 0.5, sky), 4096)))
            .iter()
            .sum();
        let whole = mean(&render_truth(
            &floor_scene(finish, 0.5, Background::Constant(Vec3::ONE)),
            1024,
        ));
        // 144 pixels of 4096 samples whose deviation is about 1.
        assert!((sum - whole).abs() < 4e-3, "{finish:?}: {sum} {whole}");
    }
}
