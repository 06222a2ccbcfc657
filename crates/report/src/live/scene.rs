//! A scene of live cases: what filters get, and what their output is compared with.

use std::collections::BTreeMap;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use filters::EXCLUSION;
use measure::FilterFrame;
use serde_json::{Map, json};

use crate::pixels::planes::deflate;
use crate::pixels::scene_files::SceneFiles;

/// Writes a scene as JSON. Adds the regions of its truths to its planes, as numbers that are 1
/// where scores are pooled, and the truths' noise.
pub fn scene_json(files: &mut SceneFiles) -> String {
    let (whole, inner) = (files.whole.size(), files.frame.size());
    let band = files.whole.guard_band;
    let [mut truths, mut noises, mut regions] = [(); 3].map(|()| Map::new());
    for (alignment, truth) in &files.truths {
        let moving = truth.regions.moving.map(|moves| f32::from(*moves));
        let name = alignment.to_string();
        truths.insert(name.clone(), json!(truth.color_planes()));
        noises.insert(name.clone(), json!(files.planes.add(&truth.noise)));
        regions.insert(name, json!(files.planes.add(&moving)));
    }
    let scene = json!({
        "width": whole.width,
        "height": whole.height,
        "crop": { "x": band, "y": band, "width": inner.width, "height": inner.height },
        "inputs": list_inputs(&files.whole),
        "stops": files.frame.display.stops,
        "frame": files.color_planes(),
        "truth": truths,
        "moving": regions,
        "noise": noises,
    });
    scene.to_string()
}

/// Packs the inputs as 32-bit floats: halves would change velocities by up to 0.015 pixels and
/// depths by 0.05 %, which moves taps.
fn list_inputs(frame: &FilterFrame) -> BTreeMap<&'static str, String> {
    let next = frame.velocity_next.as_ref();
    let z = frame.velocity_z.as_ref();
    let color = ("color", frame.color.pixels.as_flattened());
    let velocity = ("velocity", frame.velocity.pixels.as_flattened());
    let further = next.map(|next| ("velocity_next", next.pixels.as_flattened()));
    let z = z.map(|z| ("velocity_z", &z.pixels[..]));
    let all = [color, velocity, ("depth", &frame.depth.pixels[..])].into_iter();
    let mask = frame.exclusion.as_ref();
    let mask = mask.map(|mask| (EXCLUSION, &mask.pixels[..]));
    let all = all.chain(further).chain(z).chain(mask);
    all.map(|(name, numbers)| (name, compress(numbers)))
        .collect()
}

/// Writes numbers as base64 of zlib, the lowest byte of each first.
fn compress(numbers: &[f32]) -> String {
    let bytes: Vec<u8> = numbers
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect();
    STANDARD.encode(deflate(&bytes))
}
