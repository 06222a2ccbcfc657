//! The sky that an export has, and the files of a capture.

use std::path::Path;

use bevy::asset::RenderAssetUsages;
use bevy::prelude::*;
use bevy::render::render_resource::{
    Extent3d, TextureDimension, TextureFormat, TextureViewDescriptor, TextureViewDimension,
};
use exr::prelude::{
    AnyChannel, AnyChannels, FlatSamples, SmallVec, WritableImage, read_first_flat_layer_from_file,
};
use serde_json::Value;

/// Side of a face of the sky, in pixels.
const FACE: u32 = 512;

/// Reads a sky by longitude and latitude, with -Z in the middle and +X to its right, into the six faces that Bevy samples.
pub fn read_sky(path: &Path) -> Image {
    let layer = read_first_flat_layer_from_file(path)
        .expect("the exported sky")
        .layer_data;
    let size = layer.size;
    let plane = |name: &str| -> Vec<f32> {
        let mut channels = layer.channel_data.list.iter();
        let channel = channels
            .find(|channel| channel.name.eq(name))
            .expect("a sky of three channels");
        channel.sample_data.values_as_f32().collect()
    };
    let planes = ["R", "G", "B"].map(plane);
    let mut bytes = Vec::new();
    for face in 0..6 {
        for texel in 0..FACE * FACE {
            let [u, v] =
                [texel % FACE, texel / FACE].map(|at| 2.0 * (at as f32 + 0.5) / FACE as f32 - 1.0);
            // Cube maps are left-handed; Bevy turns its directions' z round.
            let d = [
                [1.0, -v, u],
                [-1.0, -v, -u],
                [u, 1.0, -v],
                [u, -1.0, v],
                [u, -v, -1.0],
                [-u, -v, 1.0],
            ][face];
            let d = Vec3::from_array(d).normalize();
            let turn = d.x.atan2(-d.z) / std::f32::consts::TAU + 0.5;
            let fall = d.y.acos() / std::f32::consts::PI;
            let x = ((turn * size.0 as f32) as usize).min(size.0 - 1);
            let y = ((fall * size.1 as f32) as usize).min(size.1 - 1);
            for plane in &planes {
                bytes.extend(plane[y * size.0 + x].to_le_bytes());
            }
            bytes.extend(1.0_f32.to_le_bytes());
        }
    }
    let size = Extent3d {
        width: FACE,
        height: FACE,
        depth_or_array_layers: 6,
    };
    let mut image = Image::new(
        size,
        TextureDimension::D2,
        bytes,
        TextureFormat::Rgba32Float,
        RenderAssetUsages::RENDER_WORLD,
    );
    let dimension = Some(TextureViewDimension::Cube);
    image.texture_view_descriptor = Some(TextureViewDescriptor {
        dimension,
        ..default()
    });
    image
}

/// Writes 32-bit channels.
pub fn write_exr(
    path: &Path,
    [width, height]: [u32; 2],
    names: &[&str],
    pixel: impl Fn(usize) -> Vec<f32>,
) {
    let pixels: Vec<Vec<f32>> = (0..(width * height) as usize).map(pixel).collect();
    let channels = names.iter().enumerate().map(|(at, name)| {
        AnyChannel::new(
            *name,
            FlatSamples::F32(pixels.iter().map(|pixel| pixel[at]).collect()),
        )
    });
    let channels: SmallVec<[_; 4]> = channels.collect();
    let image = exr::prelude::Image::from_channels(
        (width as usize, height as usize),
        AnyChannels::sort(channels),
    );
    image.write().to_file(path).expect("a folder to write to");
}

/// Averages squares of `fine` by `fine` pixels.
pub fn box_filter(pixels: &[[f32; 3]], [width, height]: [u32; 2], fine: u32) -> Vec<[f32; 3]> {
    let mut means = vec![[0.0; 3]; (width * height) as usize];
    for (at, pixel) in pixels.iter().enumerate() {
        let [x, y] = [at as u32 % (width * fine), at as u32 / (width * fine)];
        let mean = &mut means[(y / fine * width + x / fine) as usize];
        for (sum, part) in mean.iter_mut().zip(pixel) {
            *sum += part / (fine * fine) as f32;
        }
    }
    means
}

/// Writes capture.toml and engine.toml.
pub fn write_description(out: &Path, manifest: &Value, subframes: usize, near: f32) {
    let (scene, exposure) = (
        manifest["scene"].as_str().unwrap(),
        manifest["exposure"].as_f64().unwrap(),
    );
    let capture = format!(
        "engine = \"Bevy 0.19.1\"\nscene = \"{scene}\"\nexposure = {exposure:?}\nalignment = \"centred\"\nsubframes = {subframes}\n"
    );
    let convention =
        format!("[convention]\nvelocity = \"uv\"\ndepth = \"reversed\"\nnear = {near}\n");
    std::fs::write(out.join("capture.toml"), capture).unwrap();
    std::fs::write(out.join("engine.toml"), convention).unwrap();
}
