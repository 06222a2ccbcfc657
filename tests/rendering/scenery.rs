//! Poses, skies, suns and floors shared by several tests.

use std::f64::consts::FRAC_PI_2;

use glam::{DQuat, DVec3, Vec3};
use tests::shapes::*;
use tracer::{Background, Key, Material, Motion, Scene, Sun};

/// Makes a pose without rotation at a time.
pub fn key(time: f64, translation: DVec3) -> Key {
    Key {
        time,
        translation,
        ..Key::REST
    }
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

/// Makes a motion at constant velocities through keys.
pub fn through(keys: impl Into<Vec<Key>>) -> Motion {
    Motion {
        keys: keys.into(),
        ..Motion::default()
    }
}

/// Makes a grey sky that changes with the height.
pub fn heights(ground: f32, horizon: f32, zenith: f32) -> Background {
    Background::Gradient {
        ground: Vec3::splat(ground),
        horizon: Vec3::splat(horizon),
        zenith: Vec3::splat(zenith),
    }
}

/// Makes a white sun; its angular radius is in radians.
pub fn sun(direction: DVec3, irradiance: f32, angular_radius: f64) -> Option<Sun> {
    Some(Sun {
        direction: direction.normalize(),
        irradiance: Vec3::splat(irradiance),
        angular_radius,
    })
}

/// Returns the part of unpolarised light that one smooth side of an index reflects, by Fresnel's equations.
pub fn fresnel(cosine: f64, index: f64) -> f64 {
    // Snell's law.
    let inside = (1.0 - (1.0 - cosine * cosine) / (index * index)).sqrt();
    let across = (cosine - index * inside) / (cosine + index * inside);
    let along = (index * cosine - inside) / (index * cosine + inside);
    0.5 * (across * across + along * along)
}

/// Makes a floor at y = 0, with one small spot that the camera sees at a slope of 1 to 2. There the light of a lamp 1 m above varies by
/// less than 2e-6 of itself.
pub fn floor_scene(material: Material) -> Scene {
    let mut scene = empty_scene("floor");
    let floor = facing_up(DVec3::ZERO);
    add(&mut scene, rectangle(100.0, 100.0), material, floor);
    look_at_a_spot(&mut scene);
    scene
}
