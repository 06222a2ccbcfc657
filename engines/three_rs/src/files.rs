//! The files of a capture, and the sky of an export.

use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, FlatSamples, Image, SmallVec, WritableImage,
    read_first_flat_layer_from_file,
};
use serde_json::Value;
use three_rs::Texture;

/// Reads a sky by longitude and latitude.
pub fn read_sky(path: &Path) -> Texture {
    let layer = read_first_flat_layer_from_file(path)
        .expect("the exported sky")
        .layer_data;
    let planes = ["R", "G", "B"].map(|name| -> Vec<f32> {
        let mut channels = layer.channel_data.list.iter();
        let channel = channels
            .find(|channel| channel.name.eq(name))
            .expect("a sky of three channels");
        channel.sample_data.values_as_f32().collect()
    });
    let texels: Vec<f32> = (0..planes[0].len())
        .flat_map(|at| [planes[0][at], planes[1][at], planes[2][at], 1.0])
        .collect();
    Texture::data_rgba32float(layer.size.0 as u32, layer.size.1 as u32, &texels)
}

/// Writes 32-bit channels; a pixel has four, and the first of them are named.
pub fn write_exr(path: &Path, (width, height): (u32, u32), names: &[&str], pixels: &[[f32; 4]]) {
    let channels = names.iter().enumerate().map(|(at, name)| {
        let samples = pixels.iter().map(|pixel| pixel[at]).collect();
        AnyChannel::new(*name, FlatSamples::F32(samples))
    });
    let channels: SmallVec<[_; 4]> = channels.collect();
    let size = (width as usize, height as usize);
    Image::from_channels(size, AnyChannels::sort(channels))
        .write()
        .to_file(path)
        .expect("a folder to write to");
}

/// Writes capture.toml and engine.toml.
pub fn write_description(out: &Path, manifest: &Value, subframes: usize, near: f64, far: f64) {
    let scene = manifest["scene"].as_str().unwrap();
    let exposure = manifest["exposure"].as_f64().unwrap();
    // The taps of the blur are on both sides of a pixel.
    let capture = format!(
        "engine = \"three-rs 0.3.0\"\nscene = \"{scene}\"\nexposure = {exposure:?}\n\
         alignment = \"centred\"\nsubframes = {subframes}\n"
    );
    // A point's normalised device coordinates now, minus those a frame ago.
    let convention = format!(
        "[convention]\nvelocity = \"ndc\"\nvelocity_y = \"up\"\ndepth = \"forward\"\n\
         near = {near:?}\nfar = {far:?}\n"
    );
    std::fs::write(out.join("capture.toml"), capture).unwrap();
    std::fs::write(out.join("engine.toml"), convention).unwrap();
}
