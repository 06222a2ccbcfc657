//! Scenes with radiance in closed form.

use std::f64::consts::{PI, TAU};

use frame::Truth;
use glam::{DQuat, DVec3, Vec2, Vec3};
use scene::{Background, Key, Scene, Texture};
use tests::statistics::{estimate_pixels, expect_pooled_agreement};

use crate::deforming::deforming_mesh;
use crate::renders::*;
use crate::translucency::{film, glass};

/// Fails unless the first component agrees with one known value.
fn expect_everywhere(what: &str, truth: &Truth, expected: f64) {
    expect_pooled_agreement(what, &estimate_pixels(truth, |_, _| expected));
}

fn grey_floor() -> Scene {
    floor_scene(diffuse(0.6))
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
    let mut paint = glowing(2.0);
    (paint.emission_texture, paint.opacity_texture) = (Some(0), Some(0));
    let at = placed(DVec3::new(0.0, 0.0, -4.5));
    add(&mut scene, panel, paint, at);
    let mean = render_small_truth(&scene, 64).mean();
    // Pixels between texels of one quadrant, where interpolation changes nothing.
    for (x, y, expected) in [(3, 2, 0.9), (12, 2, 0.4), (3, 6, 0.6), (12, 6, 0.8)] {
        let level = mean.color.at(x, y)[0];
        assert!((level - expected).abs() < 1e-6, "{level} at ({x}, {y})");
    }
    // Interpolated alpha is below 0.5 in a square of two texels with rounded corners: 4 (0.5 + 0.75
    // - ln(2) / 2) of 16 texels.
    let area: f64 = mean.coverage[0].pixels.iter().copied().map(f64::from).sum();
    let expected = 144.0 / 16.0 * 4.0 * (1.25 - 0.5 * 2f64.ln());
    // Rms 0.02 in about 25 border pixels: 0.1 in the sum.
    expect_near("pixels of the hole", area, expected, 0.5);
}

#[test]
fn a_closed_glowing_sphere_has_the_radiance_of_the_geometric_series() {
    for albedo in [0.2, 0.5, 0.8] {
        let mut scene = empty_scene("furnace");
        let mut walls = diffuse(albedo);
        walls.emission = Vec3::splat(1.0 - albedo);
        let motion = spin(DVec3::ZERO, DVec3::Y, 2.0);
        add(&mut scene, icosphere(3.0, 2), walls, motion);
        let truth = render_small_truth(&scene, 256);
        expect_everywhere(&format!("albedo {albedo}"), &truth, 1.0);
    }
}

#[test]
fn white_things_under_a_white_sky_cannot_be_seen() {
    let mut scene = empty_scene("white");
    scene.background = Background::Constant(Vec3::ONE);
    let away = |x: f64| DVec3::new(x, 0.0, -4.0);
    let pillar = cuboid(Vec3::new(0.3, 3.0, 0.3));
    let clear = glass(1.5, Vec3::ONE);
    let mut dirty = glass(1.9, Vec3::ONE);
    (dirty.opacity, dirty.diffuse) = (0.3, Vec3::ONE);
    let white = || diffuse(1.0);
    // Smooth normals, concave corners, glass and motion must neither take nor give energy.
    for (mesh, material, motion) in [
        (icosphere(1.5, 1), white(), spin(away(-1.0), DVec3::Y, 2.0)),
        (cuboid(Vec3::ONE), white(), spin(away(0.5), DVec3::Z, 3.0)),
        (pillar.clone(), white(), drift(away(0.8), DVec3::X)),
        (cuboid(Vec3::ONE), clear, spin(away(-1.0), DVec3::Z, 2.0)),
        (pillar, dirty, drift(away(1.6), DVec3::X)),
    ] {
        add(&mut scene, mesh, material, motion);
    }
    let truth = render_small_truth(&scene, 256);
    let coverage = truth.mean().coverage;
    assert!(coverage[0].pixels.contains(&0.0));
    assert!(coverage[5].pixels.iter().any(|share| *share > 0.1));
    // Every path ends in the sky with all its energy, whatever its length.
    expect_everywhere("white", &truth, 1.0);
}

#[test]
fn a_smooth_normal_shades_and_transforms_as_a_normal() {
    let mut scene = grey_floor();
    let normal = Vec3::new(0.3, 0.2, 1.0).normalize();
    scene.meshes[0].normals = vec![normal; 4];
    let scale = DVec3::new(2.0, 0.5, 1.5);
    scene.objects[0].motion.keys[0].scale = scale;
    let light = DVec3::new(-0.1, 1.0, 0.2).normalize();
    scene.sun = sun(light, 1.0, 0.0);
    // A normal shrinks where its surface grows; then it is turned to face upwards.
    let moved = DQuat::from_rotation_x(-0.5 * PI) * (normal.as_dvec3() / scale).normalize();
    let expected = 0.6 * moved.dot(light) / PI;
    expect_everywhere("smooth", &render_small_truth(&scene, 16), expected);
}

#[test]
fn a_floor_under_a_glowing_disc_has_the_radiance_of_its_form_factor() {
    let translucent = film(Vec3::ONE, 0.25, Vec3::ONE);
    // The lamps go from small ones, where light samples weigh most, to large ones, where the lobe's
    // samples do.
    for (radius, lamp, opacity) in [
        (0.02, glowing(1.0), 1.0),
        (0.5, glowing(1.0), 1.0),
        (4.0, glowing(1.0), 1.0),
        (0.5, translucent, 0.25),
    ] {
        let mut scene = grey_floor();
        add(&mut scene, disc(radius, 256), lamp, facing_up(DVec3::Y));
        if radius > 1.0 {
            // The eye must stay below the lamp.
            let eye = DVec3::new(4.0, 0.5, 0.0);
            let towards = DQuat::from_rotation_arc(DVec3::NEG_Z, -eye.normalize());
            scene.camera.motion = turned(eye, towards);
        }
        // Irradiance over pi below the centre of a parallel disc of radiance 1.
        let squared = f64::from(radius).powi(2);
        let expected = opacity * 0.6 * squared / (1.0 + squared);
        let what = format!("radius {radius}, opacity {opacity}");
        expect_everywhere(&what, &render_small_truth(&scene, 512), expected);
    }
}

#[test]
fn a_growing_lamp_gives_the_mean_of_its_form_factors() {
    let at_width = |time: f64, scale: f64| Key {
        time,
        scale: DVec3::new(scale, scale, 1.0),
        ..facing_up(DVec3::Y).keys[0]
    };
    let lamp = disc(1.0, 256);
    let scaled = through([at_width(-0.5, 0.5), at_width(0.5, 2.0)]);
    let grown = deforming_mesh(lamp.clone(), &[-0.5, 0.5], |place, time| {
        (1.25 + 1.5 * time as f32) * place
    });
    // The mean of r^2 / (1 + r^2) for r from 0.5 to 2.
    let expected = 0.6 * (1.0 - (2.0_f64.atan() - 0.5_f64.atan()) / 1.5);
    for (what, lamp, motion) in [
        ("scaled", lamp, scaled),
        ("deforming", grown, facing_up(DVec3::Y)),
    ] {
        let mut scene = grey_floor();
        add(&mut scene, lamp, glowing(1.0), motion);
        expect_everywhere(what, &render_small_truth(&scene, 512), expected);
    }
}

#[test]
fn the_sun_lights_a_floor_by_the_cosine() {
    for (angular_radius, elevation, color) in
        [(0.0, 0.6, 3.0), (0.005, 0.5 * PI, 2.0), (0.3, 0.6, 3.0)]
    {
        let mut scene = grey_floor();
        let direction = DVec3::new(0.0, f64::sin(elevation), f64::cos(elevation));
        scene.sun = sun(direction, color, angular_radius);
        // A disc wholly above the horizon gives its irradiance times its centre's cosine.
        let expected = 0.6 * f64::from(color) * f64::sin(elevation) / PI;
        let what = format!("radius {angular_radius}, elevation {elevation}");
        expect_everywhere(&what, &render_small_truth(&scene, 256), expected);
    }
}

#[test]
fn a_surface_in_the_sun_s_shadow_is_black_and_a_hole_lets_it_through() {
    for (opacity, expected) in [(1.0, 0.0), (0.49, 0.6 / PI)] {
        let mut scene = grey_floor();
        scene.sun = sun(DVec3::Y, 1.0, 0.0);
        let mut screen = diffuse(0.0);
        screen.opacity = opacity;
        let above = facing_up(DVec3::Y);
        add(&mut scene, rectangle(1.0, 1.0), screen, above);
        let what = format!("opacity {opacity}");
        expect_everywhere(&what, &render_small_truth(&scene, 64), expected);
    }
}

#[test]
fn a_sun_with_a_disc_is_seen_and_a_point_is_not() {
    let mut scene = empty_scene("sun");
    scene.camera.vertical_fov = vec![(0.0, 0.02)];
    let radiance = 1.0 / (PI * f64::sin(0.2).powi(2));
    for (angular_radius, expected) in [(0.0, 0.0), (0.2, radiance)] {
        scene.sun = sun(DVec3::NEG_Z, 1.0, angular_radius);
        let what = format!("radius {angular_radius}");
        expect_everywhere(&what, &render_small_truth(&scene, 16), expected);
    }
}

#[test]
fn a_sky_and_its_image_light_a_floor_by_the_cosine() {
    for (sky, expected) in [
        (heights(1.0, 1.0, 1.0), 0.6),
        // Gradients are hit by chance, and uneven images sampled as lights. The mean of the height
        // over the cosine lobe is 2/3.
        (heights(1.0, 1.0, 4.0), 0.6 * 3.0),
        (heights(0.0, 0.0, 1.0), 0.4),
        (heights(9.0, 0.0, 1.0), 0.4),
    ] {
        for background in [image_of(&sky), sky] {
            let mut scene = grey_floor();
            scene.background = background;
            // Interpolation between rows of 3 degrees smooths the horizon's kink: about 5e-4 of the
            // brightest level above.
            expect_near("floor", mean_radiance(&scene, 1024), expected, 2e-3);
        }
    }
}

#[test]
fn a_small_bright_sun_in_an_image_is_found() {
    let mut scene = grey_floor();
    // The sun is one texel, 39 degrees from straight up.
    let bright = |x, y| [f32::from((x, y) == (20, 6)) * 1000.0; 3];
    scene.background = map(64, 0.0, bright);
    // The bilinear tent around the texel's middle, by the midpoint rule.
    let steps = 200;
    let irradiance: f64 = (0..steps * steps)
        .map(|at| [at % steps, at / steps].map(|step| (f64::from(step) + 0.5) / f64::from(steps)))
        .map(|[x, y]| {
            let [x, y] = [2.0 * x - 1.0, 2.0 * y - 1.0];
            let polar = PI * (6.5 + y) / 32.0;
            let area = 4.0 * TAU / 64.0 * PI / 32.0 * polar.sin();
            let tent = (1.0 - x.abs()) * (1.0 - y.abs());
            1000.0 * tent * area * polar.cos() / f64::from(steps * steps)
        })
        .sum();
    let truth = render_small_truth(&scene, 512);
    expect_everywhere("sun in an image", &truth, 0.6 * irradiance / PI);
    // Without light samples, one path in 500 would hit it, with a deviation of 20 times its mean.
    let estimates = estimate_pixels(&truth, |_, _| 0.0).into_iter();
    let worst = estimates.map(|estimate| estimate.error).fold(0.0, f64::max);
    assert!(worst < 0.01 * irradiance, "{worst} {irradiance}");
}
