//! Scenes with radiance in closed form.

use std::f64::consts::{PI, TAU};

use frame::Truth;
use glam::{DQuat, DVec3, Vec2, Vec3};
use tests::shapes::*;
use tests::statistics::{estimate_pixels, expect_pooled_agreement};
use tracer::{Background, EnvironmentMap, Key, Material, Motion, Scene, Sun, Texture, Turn};

use crate::small_truths::render_truth;

/// Fails unless the first component agrees with one known value.
fn expect_everywhere(what: &str, truth: &Truth, expected: f64) {
    expect_pooled_agreement(what, &estimate_pixels(truth, |_, _| expected));
}

/// Points the camera from `eye` at `target`, with a vertical field of view in degrees.
fn look_at(scene: &mut Scene, eye: DVec3, target: DVec3, degrees: f64) {
    scene.camera.motion = Motion::still(Key {
        translation: eye,
        orientation: DQuat::from_rotation_arc(DVec3::NEG_Z, (target - eye).normalize()),
        ..Key::REST
    });
    scene.camera.vertical_fov = vec![(0.0, degrees.to_radians())];
}

/// Returns the pose of a rectangle or disc that faces upwards.
fn facing_up(at: DVec3) -> Key {
    Key {
        translation: at,
        orientation: DQuat::from_rotation_x(-0.5 * PI),
        ..Key::REST
    }
}

/// Makes a floor at y = 0 of albedo 0.6, seen in a spot of 2 mm around the origin. There the light of a lamp 1 m above
/// varies by less than 2e-6 of itself.
fn floor_scene(name: &str) -> Scene {
    let mut scene = empty_scene(name);
    let floor = Motion::still(facing_up(DVec3::ZERO));
    add(&mut scene, rectangle(100.0, 100.0), diffuse(0.6), floor);
    look_at(&mut scene, DVec3::new(4.0, 2.0, 0.0), DVec3::ZERO, 0.005);
    scene
}

#[test]
fn a_floor_under_a_gradient_sky_gathers_it_by_the_cosine() {
    let mut scene = floor_scene("sky");
    scene.background = Background::Gradient {
        ground: Vec3::splat(100.0),
        horizon: Vec3::splat(1.0),
        zenith: Vec3::splat(4.0),
    };
    // The mean of the height over the cosine lobe is 2/3.
    let expected = 0.6 * (1.0 + 3.0 * 2.0 / 3.0);
    expect_everywhere("gradient", &render_truth(&scene, 256), expected);
}

#[test]
fn a_textured_panel_hangs_upright_and_has_its_holes() {
    let quadrants = [[0.1, 0.2], [0.3, 0.4]];
    // The upper left quadrant is a hole.
    let texel = |x: usize, y: usize| {
        let value = quadrants[y / 2][x / 2];
        let alpha = if x < 2 && y < 2 { 0.0 } else { 1.0 };
        [value, value, value, alpha]
    };
    let mut scene = empty_scene("texture");
    scene.background = Background::Constant(Vec3::splat(0.9));
    scene.textures.push(Texture {
        path: "made by a test".into(),
        width: 4,
        height: 4,
        texels: (0..16).map(|index| texel(index % 4, index / 4)).collect(),
    });
    // One metre is one pixel; the panel fills the picture.
    let mut panel = rectangle(16.0, 9.0);
    panel.texcoords = vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    let paint = Material {
        emission_texture: Some(0),
        opacity_texture: Some(0),
        ..glowing(2.0)
    };
    let at = placed(DVec3::new(0.0, 0.0, -4.5));
    add(&mut scene, panel, paint, at);
    let mean = render_truth(&scene, 64).mean();
    // Pixels between texels of one quadrant, where interpolation changes nothing.
    for (x, y, expected) in [(3, 2, 0.9), (12, 2, 0.4), (3, 6, 0.6), (12, 6, 0.8)] {
        let found = mean.color.at(x, y)[0];
        assert!((found - expected).abs() < 1e-6, "{found} at ({x}, {y})");
    }
    // Interpolated alpha is below 0.5 in a square of two texels with rounded corners: 4 (0.5 + 0.75 - ln(2) / 2) of 16
    // texels.
    let area: f64 = mean.coverage[0].pixels.iter().copied().map(f64::from).sum();
    let expected = 144.0 / 16.0 * 4.0 * (1.25 - 0.5 * 2f64.ln());
    // Rms 0.02 in about 25 border pixels: 0.1 in the sum.
    assert!(
        (area - expected).abs() < 0.5,
        "the hole covers {area} pixels, not {expected}"
    );
}

#[test]
fn a_closed_glowing_sphere_has_the_radiance_of_the_geometric_series() {
    for albedo in [0.2, 0.5, 0.8] {
        let mut scene = empty_scene("furnace");
        let walls = Material {
            emission: Vec3::splat(1.0 - albedo),
            ..diffuse(albedo)
        };
        let motion = spin(DVec3::ZERO, DVec3::Y, 2.0);
        add(&mut scene, icosphere(3.0, 2), walls, motion);
        expect_everywhere(&format!("albedo {albedo}"), &render_truth(&scene, 256), 1.0);
    }
}

#[test]
fn white_things_under_a_white_sky_cannot_be_seen() {
    let mut scene = empty_scene("white");
    scene.background = Background::Constant(Vec3::ONE);
    let away = |x: f64| DVec3::new(x, 0.0, -4.0);
    // Smooth normals, concave corners and motion must neither take nor give energy.
    add(
        &mut scene,
        icosphere(1.5, 1),
        diffuse(1.0),
        spin(away(-1.0), DVec3::Y, 2.0),
    );
    add(
        &mut scene,
        cuboid(Vec3::ONE),
        diffuse(1.0),
        spin(away(0.5), DVec3::Z, 3.0),
    );
    add(
        &mut scene,
        cuboid(Vec3::new(0.3, 3.0, 0.3)),
        diffuse(1.0),
        drift(away(0.8), DVec3::X),
    );
    let truth = render_truth(&scene, 256);
    assert!(truth.mean().coverage[0].pixels.contains(&0.0));
    // Every path ends in the sky with all its energy, whatever its length.
    expect_everywhere("white", &truth, 1.0);
}

#[test]
fn a_convex_body_under_a_white_sky_has_the_radiance_of_its_albedo() {
    let mut scene = empty_scene("convex");
    scene.background = Background::Constant(Vec3::ONE);
    // With few facets smooth normals lean far. The body fills the picture, so that every pixel is the body's.
    let near = DVec3::new(0.0, 0.0, -1.3);
    let body = icosphere(1.0, 0);
    add(&mut scene, body, diffuse(0.5), spin(near, DVec3::Y, 2.0));
    scene.camera.vertical_fov = vec![(0.0, 0.5)];
    expect_everywhere("grey", &render_truth(&scene, 256), 0.5);
}

#[test]
fn a_smooth_normal_shades_and_transforms_as_a_normal() {
    let mut scene = floor_scene("smooth");
    let normal = Vec3::new(0.3, 0.2, 1.0).normalize();
    scene.meshes[0].normals = vec![normal; 4];
    let scale = DVec3::new(2.0, 0.5, 1.5);
    scene.objects[0].motion.keys[0].scale = scale;
    let sun = DVec3::new(-0.1, 1.0, 0.2).normalize();
    scene.sun = Some(Sun {
        direction: sun,
        irradiance: Vec3::ONE,
        angular_radius: 0.0,
    });
    // A normal shrinks where its surface grows; then it is turned to face upwards.
    let moved = DQuat::from_rotation_x(-0.5 * PI) * (normal.as_dvec3() / scale).normalize();
    let expected = 0.6 * moved.dot(sun) / PI;
    expect_everywhere("smooth", &render_truth(&scene, 16), expected);
}

/// Returns irradiance over pi, times albedo, below the centre of a parallel disc of radiance 1 (radius / height =
/// `ratio`).
fn under_disc(albedo: f64, ratio: f64) -> f64 {
    albedo * ratio * ratio / (1.0 + ratio * ratio)
}

#[test]
fn a_floor_under_a_glowing_disc_has_the_radiance_of_its_form_factor() {
    // From small lamps, where light samples weigh most, to large ones, where the lobe's samples do.
    for radius in [0.02, 0.5, 4.0] {
        let mut scene = floor_scene("disc");
        let lamp = Motion::still(facing_up(DVec3::new(0.0, 1.0, 0.0)));
        add(&mut scene, disc(radius, 256), glowing(1.0), lamp);
        if radius > 1.0 {
            // The eye must stay below the lamp.
            look_at(&mut scene, DVec3::new(4.0, 0.5, 0.0), DVec3::ZERO, 0.005);
        }
        let expected = under_disc(0.6, f64::from(radius));
        expect_everywhere(
            &format!("radius {radius}"),
            &render_truth(&scene, 512),
            expected,
        );
    }
}

#[test]
fn a_growing_lamp_gives_the_mean_of_its_form_factors() {
    let mut scene = floor_scene("growing disc");
    let at_width = |time: f64, scale: f64| Key {
        time,
        scale: DVec3::new(scale, scale, 1.0),
        turn: Turn::NONE,
        ..facing_up(DVec3::new(0.0, 1.0, 0.0))
    };
    let lamp = Motion {
        keys: vec![at_width(-0.5, 0.5), at_width(0.5, 2.0)],
        ..Motion::default()
    };
    add(&mut scene, disc(1.0, 256), glowing(1.0), lamp);
    // The mean of r^2 / (1 + r^2) for r from 0.5 to 2.
    let expected = 0.6 * (1.0 - (2.0_f64.atan() - 0.5_f64.atan()) / 1.5);
    expect_everywhere("growing lamp", &render_truth(&scene, 512), expected);
}

#[test]
fn the_sun_lights_a_floor_by_the_cosine() {
    for angular_radius in [0.0, 0.005, 0.3] {
        for (elevation, color) in [(PI / 2.0, 2.0), (0.6, 3.0)] {
            let mut scene = floor_scene("sun");
            scene.sun = Some(Sun {
                direction: DVec3::new(0.0, f64::sin(elevation), f64::cos(elevation)),
                irradiance: Vec3::splat(color),
                angular_radius,
            });
            // A disc wholly above the horizon gives its irradiance times its centre's cosine.
            let expected = 0.6 * f64::from(color) * f64::sin(elevation) / PI;
            let what = format!("radius {angular_radius}, elevation {elevation}");
            expect_everywhere(&what, &render_truth(&scene, 256), expected);
        }
    }
}

#[test]
fn a_surface_in_the_sun_s_shadow_is_black_and_a_hole_lets_it_through() {
    for opacity in [1.0, 0.49] {
        let mut scene = floor_scene("shadow");
        scene.sun = Some(Sun {
            direction: DVec3::Y,
            irradiance: Vec3::ONE,
            angular_radius: 0.0,
        });
        let screen = Material {
            opacity,
            ..diffuse(0.0)
        };
        let above = Motion::still(facing_up(DVec3::new(0.0, 1.0, 0.0)));
        add(&mut scene, rectangle(1.0, 1.0), screen, above);
        let expected = if opacity < 0.5 { 0.6 / PI } else { 0.0 };
        expect_everywhere(
            &format!("opacity {opacity}"),
            &render_truth(&scene, 64),
            expected,
        );
    }
}

#[test]
fn a_sun_with_a_disc_is_seen_and_a_point_is_not() {
    let sun = |angular_radius| Sun {
        direction: DVec3::NEG_Z,
        irradiance: Vec3::ONE,
        angular_radius,
    };
    let mut scene = empty_scene("sun");
    look_at(&mut scene, DVec3::ZERO, DVec3::NEG_Z, 1.0);
    scene.sun = Some(sun(0.0));
    expect_everywhere("point", &render_truth(&scene, 16), 0.0);
    scene.sun = Some(sun(0.2));
    let radiance = 1.0 / (PI * f64::sin(0.2).powi(2));
    expect_everywhere("disc", &render_truth(&scene, 16), radiance);
}

/// Makes an environment map of `sky` in 128 x 64 texels.
fn image_of(sky: &Background) -> Background {
    let (width, height) = (128, 64);
    let texel = |at: u32| {
        let [x, y] = [at % width, at / width].map(|place| f64::from(place) + 0.5);
        let (across, ahead) = (TAU * (x / f64::from(width) - 0.5)).sin_cos();
        let (level, up) = (PI * y / f64::from(height)).sin_cos();
        sky.radiance(DVec3::new(level * across, up, -level * ahead))
            .into()
    };
    Background::Map(EnvironmentMap {
        path: "made by a test".into(),
        width,
        height,
        texels: (0..width * height).map(texel).collect(),
        strength: 1.0,
        rotation: 0.3,
    })
}

#[test]
fn an_image_of_a_sky_lights_like_the_sky() {
    let level = |brightness| Vec3::splat(brightness);
    for (sky, expected) in [
        (Background::Constant(level(1.0)), 0.6),
        // Even and uneven skies: one is met by chance, the other sampled as a light. The mean of the height over the
        // cosine lobe is 2/3.
        (
            Background::Gradient {
                ground: level(1.0),
                horizon: level(1.0),
                zenith: level(4.0),
            },
            0.6 * 3.0,
        ),
        (
            Background::Gradient {
                ground: level(0.0),
                horizon: level(0.0),
                zenith: level(1.0),
            },
            0.4,
        ),
    ] {
        let mut scene = floor_scene("image");
        scene.background = image_of(&sky);
        let mean = render_truth(&scene, 4096).mean().color;
        let sum: f64 = mean.pixels.iter().map(|pixel| f64::from(pixel[0])).sum();
        let found = sum / mean.pixels.len() as f64;
        // Interpolation between rows of 3 degrees smooths the horizon's kink: about 5e-4 of the brightest level.
        assert!((found - expected).abs() < 2e-3, "{found} {expected}");
    }
}

#[test]
fn a_small_bright_sun_in_an_image_is_found() {
    let (width, height) = (64_u32, 32_u32);
    // One texel 39 degrees from straight up.
    let bright = 6 * width + 20;
    let texel = |at: u32| if at == bright { [1000.0; 3] } else { [0.0; 3] };
    let mut scene = floor_scene("sun in an image");
    scene.background = Background::Map(EnvironmentMap {
        path: "made by a test".into(),
        width,
        height,
        texels: (0..width * height).map(texel).collect(),
        strength: 1.0,
        rotation: 0.0,
    });
    // The bilinear tent around the texel's middle, by the midpoint rule.
    let steps = 200;
    let irradiance: f64 = (0..steps * steps)
        .map(|at| [at % steps, at / steps].map(|step| (f64::from(step) + 0.5) / f64::from(steps)))
        .map(|[x, y]| {
            let [x, y] = [2.0 * x - 1.0, 2.0 * y - 1.0];
            let polar = PI * (6.5 + y) / f64::from(height);
            let area = 4.0 * TAU / f64::from(width) * PI / f64::from(height) * polar.sin();
            let tent = (1.0 - x.abs()) * (1.0 - y.abs());
            1000.0 * tent * area * polar.cos() / f64::from(steps * steps)
        })
        .sum();
    let truth = render_truth(&scene, 1024);
    expect_everywhere("sun in an image", &truth, 0.6 * irradiance / PI);
    // Without light samples, one path in 500 would meet it, with a deviation of 20 times its mean.
    let worst = estimate_pixels(&truth, |_, _| 0.0)
        .iter()
        .map(|estimate| estimate.error)
        .fold(0.0, f64::max);
    assert!(worst < 0.01 * irradiance, "{worst} {irradiance}");
}
