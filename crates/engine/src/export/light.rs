//! Lights: the sun as a node, and the sky as a picture of all directions.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use frame::{ExrFile, FileError, Image, Size, write_exr};
use glam::{DQuat, DVec3};
use scene::{Background, Sun};
use serde_json::{Value, json};

use crate::export::document::{Document, widen};

/// Name of the sky's file.
pub const SKY: &str = "sky.exr";
/// Extension that describes a sun.
pub const SUN_EXTENSION: &str = "KHR_lights_punctual";
/// Size of a sky without a picture.
const SIZE: Size = Size::new(512, 256);

/// Describes the sun as a directional light. Its intensity, in lux there, is the irradiance on a
/// surface that faces it.
pub fn sun_light(sun: &Sun) -> Value {
    let strength = sun.irradiance.max_element();
    let color = if strength > 0.0 {
        sun.irradiance / strength
    } else {
        sun.irradiance
    };
    json!({
        "color": color.to_array().map(widen),
        "intensity": widen(strength),
        "name": "sun",
        "type": "directional",
    })
}

/// Adds the node of the sun, the document's only light.
pub fn push_sun(document: &mut Document, sun: &Sun) -> usize {
    // Light goes along the node's -Z, away from the sun.
    let rotation = DQuat::from_rotation_arc(DVec3::Z, sun.direction).as_quat();
    let node = json!({
        "extensions": { SUN_EXTENSION: { "light": 0 } },
        "name": "sun",
        "rotation": rotation.to_array().map(widen),
    });
    document.push("nodes", node)
}

/// Writes the radiance of every direction by longitude and latitude: the middle of the picture is
/// towards -Z, its right quarter towards +X, its top towards +Y.
pub fn write_sky(background: &Background, path: &Path) -> Result<(), FileError> {
    let Size { width, height } = match background {
        Background::Map(map) => Size::new(map.width, map.height),
        _ => SIZE,
    };
    let sky = Image::from_fn(width, height, |x, y| {
        let azimuth = TAU * ((f64::from(x) + 0.5) / f64::from(width) - 0.5);
        let polar = PI * (f64::from(y) + 0.5) / f64::from(height);
        let direction = DVec3::new(
            polar.sin() * azimuth.sin(),
            polar.cos(),
            -polar.sin() * azimuth.cos(),
        );
        background.radiance(direction).to_array()
    });
    let mut file = ExrFile::new(width, height);
    file.push_color("", &sky);
    write_exr(path, &file)
}
