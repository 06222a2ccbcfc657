//! Poses, skies and floors shared by several tests; renders, means of their colours, and comparison
//! with known numbers.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use frame::{Alignment, Frame, Image, Ladder, Truth, VelocityKind};
use glam::{DQuat, DVec3, Vec3};
use scene::{Background, EnvironmentMap, Key, Material, Motion, Scene, Sun, load_scene};
pub use tests::near::expect_near;
pub use tests::shapes::*;
use tests::{scenes, settings_of};
pub use tests::{settings, unwatched};
use tracer::{RenderSettings, trace_frame, trace_ladder, trace_truth};

/// Makes settings of a size, samples per pixel, and a kind of motion for the velocity buffer.
pub fn settings_with(
    size: [u32; 2],
    samples_per_pixel: u32,
    velocity: VelocityKind,
) -> RenderSettings {
    let mut settings = settings(size, samples_per_pixel);
    settings.options.velocity = velocity;
    settings
}

/// Makes settings of a size and samples per pixel in 2 replicates.
pub fn settings_of_two(size: [u32; 2], samples_per_pixel: u32) -> RenderSettings {
    settings_of(size, samples_per_pixel, 2)
}

pub fn render_frame(scene: &Scene, settings: &RenderSettings) -> Frame {
    trace_frame(scene, settings, &unwatched).expect("settings are allowed")
}

pub fn render_truth(scene: &Scene, settings: &RenderSettings, alignment: Alignment) -> Truth {
    trace_truth(scene, settings, alignment, &unwatched).expect("settings are allowed")
}

pub fn render_ladder(
    scene: &Scene,
    settings: &RenderSettings,
    truth: &Truth,
    subframes: &[u32],
) -> Ladder {
    trace_ladder(scene, settings, truth, subframes, &unwatched).expect("settings are allowed")
}

/// Renders a centred truth of 16 x 9 pixels.
pub fn render_small_truth(scene: &Scene, samples_per_pixel: u32) -> Truth {
    let settings = settings([16, 9], samples_per_pixel);
    render_truth(scene, &settings, Alignment::Centred)
}

/// Returns the mean of the first component over such a truth.
pub fn mean_radiance(scene: &Scene, samples_per_pixel: u32) -> f64 {
    mean_of(&render_small_truth(scene, samples_per_pixel).mean().color)
}

/// Loads a shipped scene.
pub fn load_shipped(name: &str) -> Scene {
    load_scene(scenes().join(name), None).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the mean of the first component over a picture.
pub fn mean_of(color: &Image) -> f64 {
    let values = color.pixels.iter().map(|pixel| f64::from(pixel[0]));
    values.sum::<f64>() / color.pixels.len() as f64
}

/// Returns the root of the mean squared difference of two pictures, in the first component.
pub fn rms_difference(a: &Image, b: &Image) -> f64 {
    let squares = (a.pixels.iter().zip(&b.pixels)).map(|(a, b)| f64::from(a[0] - b[0]).powi(2));
    (squares.sum::<f64>() / a.pixels.len() as f64).sqrt()
}

/// Makes a still pose.
pub fn turned(translation: DVec3, orientation: DQuat) -> Motion {
    Motion::still(Key {
        translation,
        orientation,
        ..Key::REST
    })
}

/// Makes the still pose of a rectangle or disc that faces upwards.
pub fn facing_up(at: DVec3) -> Motion {
    turned(at, DQuat::from_rotation_x(-FRAC_PI_2))
}

/// Makes a grey sky that changes with the height.
pub fn heights(ground: f32, horizon: f32, zenith: f32) -> Background {
    Background::Gradient {
        ground: Vec3::splat(ground),
        horizon: Vec3::splat(horizon),
        zenith: Vec3::splat(zenith),
    }
}

/// Makes an environment map of these texels by column and row.
pub fn map(width: u32, rotation: f64, texel: impl Fn(u32, u32) -> [f32; 3]) -> Background {
    let height = width / 2;
    let texels = (0..width * height).map(|at| texel(at % width, at / width));
    Background::Map(EnvironmentMap {
        path: "made by a test".into(),
        width,
        height,
        texels: texels.collect(),
        strength: 1.0,
        rotation,
    })
}

/// Makes an environment map of `sky`.
pub fn image_of(sky: &Background) -> Background {
    map(128, 0.3, |x, y| {
        let [x, y] = [x, y].map(|place| f64::from(place) + 0.5);
        let (across, ahead) = (TAU * (x / 128.0 - 0.5)).sin_cos();
        let (level, up) = (PI * y / 64.0).sin_cos();
        let direction = DVec3::new(level * across, up, -level * ahead);
        sky.radiance(direction).into()
    })
}

/// Makes a white sun; its angular radius is in radians.
pub fn sun(direction: DVec3, irradiance: f32, angular_radius: f64) -> Option<Sun> {
    Some(Sun {
        direction: direction.normalize(),
        irradiance: Vec3::splat(irradiance),
        angular_radius,
    })
}

/// Returns the part of unpolarised light that one smooth side of an index reflects, by Fresnel's
/// equations.
pub fn fresnel(cosine: f64, index: f64) -> f64 {
    // Snell's law.
    let inside = (1.0 - (1.0 - cosine * cosine) / (index * index)).sqrt();
    let across = (cosine - index * inside) / (cosine + index * inside);
    let along = (index * cosine - inside) / (index * cosine + inside);
    0.5 * (across * across + along * along)
}

/// Makes a floor at y = 0, with one small spot that the camera sees at a slope of 1 to 2. There the
/// light of a lamp 1 m above varies by less than 2e-6 of itself.
pub fn floor_scene(material: Material) -> Scene {
    let mut scene = empty_scene("floor");
    let floor = facing_up(DVec3::ZERO);
    add(&mut scene, rectangle(100.0, 100.0), material, floor);
    let eye = DVec3::new(4.0, 2.0, 0.0);
    scene.camera.motion = Motion::still(Key {
        translation: eye,
        orientation: DQuat::from_rotation_arc(DVec3::NEG_Z, -eye.normalize()),
        ..Key::REST
    });
    scene.camera.vertical_fov = vec![(0.0, 0.005_f64.to_radians())];
    scene
}
