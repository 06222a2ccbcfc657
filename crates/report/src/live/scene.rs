//! A scene of live cases: what filters get, and what their output is compared with.

use std::collections::BTreeMap;
use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use frame::Frame;
use serde::Serialize;

use crate::pixels::scene_files::SceneFiles;

#[derive(Serialize)]
struct LiveScene {
    /// Pixels per row and rows of the inputs.
    width: u32,
    height: u32,
    /// Part of them that is the picture.
    crop: Crop,
    /// Inputs as base64 of zlib of 32-bit floats: halves would change velocities by up to 0.015 pixels and depths by 0.05 %, which moves taps.
    inputs: BTreeMap<&'static str, String>,
    /// Display exposure, in stops.
    stops: f32,
    /// Planes of the truth by alignment.
    truth: BTreeMap<String, Vec<usize>>,
    /// Planes that are 1 where scores are pooled.
    moving: BTreeMap<String, usize>,
    /// Part of the squared error there that is the truth's own noise.
    noise: BTreeMap<String, f64>,
}

#[derive(Serialize)]
struct Crop {
    x: u32,
    y: u32,
    width: u32,
    height: u32,
}

/// Writes a scene as JSON. Adds the regions of its truths to its planes.
pub fn scene_json(files: &mut SceneFiles) -> String {
    let (width, height) = files.whole.size();
    let (inner, band) = (files.frame.size(), files.whole.guard_band);
    let truths = files.truths.iter();
    let truth = truths.map(|(alignment, truth)| (alignment.to_string(), truth.color_planes()));
    let noise = files.truths.iter();
    let noise = noise.map(|(alignment, truth)| (alignment.to_string(), truth.noise));
    let planes = &mut files.planes;
    let moving = files.truths.iter().map(|(alignment, truth)| {
        let mask = truth.regions.moving.map(|moves| f32::from(*moves));
        (alignment.to_string(), planes.add(&mask))
    });
    let scene = LiveScene {
        width,
        height,
        crop: Crop {
            x: band,
            y: band,
            width: inner.0,
            height: inner.1,
        },
        inputs: list_inputs(&files.whole),
        stops: files.frame.display.stops,
        truth: truth.collect(),
        moving: moving.collect(),
        noise: noise.collect(),
    };
    serde_json::to_string(&scene).expect("a scene is plain data")
}

fn list_inputs(frame: &Frame) -> BTreeMap<&'static str, String> {
    let next = frame.velocity_next.as_ref();
    let z = frame.velocity_z.as_ref();
    let color = ("color", frame.color.pixels.as_flattened());
    let velocity = ("velocity", frame.velocity.pixels.as_flattened());
    let further = next.map(|next| ("velocity_next", next.pixels.as_flattened()));
    let z = z.map(|z| ("velocity_z", &z.pixels[..]));
    let all = [color, velocity, ("depth", &frame.depth.pixels[..])].into_iter();
    let all = all.chain(further).chain(z);
    all.map(|(name, numbers)| (name, compress(numbers)))
        .collect()
}

/// Compresses numbers, the lowest byte of each first.
fn compress(numbers: &[f32]) -> String {
    let bytes: Vec<u8> = numbers.iter().flat_map(|it| it.to_le_bytes()).collect();
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(&bytes).expect("memory takes every byte");
    STANDARD.encode(encoder.finish().expect("memory takes every byte"))
}
