//! Lights: the sun as a node, and the sky as a picture of all directions.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use frame::{ExrFile, FileError, Image, write_exr};
use glam::{DQuat, DVec3};
use gltf_json::Index;
use gltf_json::Node;
use gltf_json::extensions::root::KhrLightsPunctual;
use gltf_json::extensions::scene::khr_lights_punctual::{
    KhrLightsPunctual as LightOfNode, Light, Type,
};
use gltf_json::scene::UnitQuaternion;
use gltf_json::validation::Checked;
use tracer::{Background, Sun};

use crate::export::buffer::Document;

/// Name of the sky's file.
pub const SKY: &str = "sky.exr";
/// Columns and rows of a sky that is no picture.
const SIZE: (u32, u32) = (512, 256);

/// Adds the sun as a directional light. Its intensity, in lux there, is the irradiance on a surface that faces it.
pub fn push_sun(document: &mut Document, sun: &Sun) -> Index<Node> {
    let strength = sun.irradiance.max_element();
    let color = match strength > 0.0 {
        true => sun.irradiance / strength,
        false => sun.irradiance,
    };
    let extensions = document.root.extensions.get_or_insert_default();
    let lights = extensions
        .khr_lights_punctual
        .get_or_insert_with(|| KhrLightsPunctual { lights: Vec::new() });
    let light = Index::push(
        &mut lights.lights,
        Light {
            color: color.to_array(),
            extensions: None,
            extras: None,
            intensity: strength,
            name: Some("sun".to_owned()),
            range: None,
            spot: None,
            type_: Checked::Valid(Type::Directional),
        },
    );
    // Light goes along the node's -Z, away from the sun.
    let rotation = DQuat::from_rotation_arc(DVec3::Z, sun.direction);
    let own = gltf_json::extensions::scene::Node {
        khr_lights_punctual: Some(LightOfNode { light }),
        ..Default::default()
    };
    document.root.push(Node {
        extensions: Some(own),
        name: Some("sun".to_owned()),
        rotation: Some(UnitQuaternion(rotation.as_quat().to_array())),
        ..Node::default()
    })
}

/// Writes the radiance of every direction by longitude and latitude: the middle of the picture lies towards -Z, its right quarter
/// towards +X, its top towards +Y.
pub fn write_sky(background: &Background, path: &Path) -> Result<(), FileError> {
    let (width, height) = match background {
        Background::Map(map) => (map.width, map.height),
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
