//! Scene folders: scene.toml, OBJ, MTL, textures and images of the background.

use std::fs;
use std::path::PathBuf;

use frame::{Alignment, FrameOptions, Image, VelocityKind};
use tests::unwatched;
use tracer::{RenderSettings, Scene, list_scenes, load_scene, trace_frame, trace_truth};

use crate::place::Place;
use crate::seeds::shipped;

/// Returns the shipped scenes, changed to use the only existing mesh.
pub fn shipped_scenes(_: &Place) -> Vec<Vec<u8>> {
    let change = |text: Vec<u8>| {
        let text = String::from_utf8(text).expect("a scene is UTF-8");
        let names = text.split('"').map(|name| match name.ends_with(".obj") {
            true => "mesh.obj",
            false => name,
        });
        let text = names.collect::<Vec<_>>().join("\"");
        let lines = text.split_inclusive('\n');
        let kept: String = lines.filter(|line| !line.starts_with("group")).collect();
        kept.into_bytes()
    };
    let scenes = shipped("scenes", "scene.toml").into_iter();
    scenes.map(change).collect()
}

/// Writes one file of a scene folder whose other files are valid, and returns the folder.
fn write(place: &Place, name: &str, input: &[u8]) -> PathBuf {
    let folder = place.copy("square").join("square");
    place.write(&format!("square/square/{name}"), input);
    folder
}

/// Loads a scene with this file as `list` does and then as `run` does: the scene, then its first variants.
pub fn load(place: &mut Place, name: &str, input: &[u8]) -> Option<Scene> {
    write(place, name, input);
    let listings = list_scenes(place.folder.join("square")).ok()?;
    let listing = listings.first()?;
    for variant in listing.variants.iter().take(2) {
        drop(load_scene(&listing.folder, Some(variant)));
    }
    load_scene(&listing.folder, None).ok()
}

/// Loads the image of a background.
pub fn load_sky(place: &mut Place, name: &str, input: &[u8]) -> Option<()> {
    let folder = write(place, name, input);
    let scene = place.fixture.join("square/square/scene.toml");
    let scene = fs::read_to_string(scene).expect("the fixture has a scene");
    let constant = "constant = [0.2, 0.2, 0.2]";
    assert!(scene.contains(constant), "the scene has a background");
    let scene = scene.replace(constant, &format!("image = \"{name}\""));
    write(place, "scene.toml", scene.as_bytes());
    load_scene(folder, None).ok().map(drop)
}

/// Renders a frame and a truth of a few pixels, which must be finite.
pub fn render_few_pixels(scene: Scene) {
    let settings = RenderSettings {
        width: 8,
        height: 8,
        options: FrameOptions {
            velocity: VelocityKind::PreviousFrame,
            ..FrameOptions::default()
        },
        samples_per_pixel: 8,
        replicates: 2,
        ..RenderSettings::default()
    };
    let check = |what: &str, image: &Image| {
        let finite = image.pixels.as_flattened().iter().all(|it| it.is_finite());
        assert!(finite, "a {what} without a word that is not finite");
    };
    if let Ok(frame) = trace_frame(&scene, &settings, &unwatched) {
        check("frame", &frame.color);
    }
    if let Ok(truth) = trace_truth(&scene, &settings, Alignment::Centred, &unwatched) {
        check("truth", &truth.mean().color);
    }
}
