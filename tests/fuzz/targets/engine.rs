//! Captures of an engine: their description, and the result of `ingest` for a run.

use std::fs;
use std::path::{Component, Path};

use engine::{Capture, ingest};
use frame::Display;
use suite::{EngineScene, INGESTED_FILE};

use crate::place::Place;

/// Reads a capture.toml with pictures of 16 x 16 pixels.
pub fn capture(place: &mut Place, input: &[u8]) -> Option<()> {
    let folder = place.copy("capture");
    place.write("capture/capture.toml", input);
    let capture = Capture::read(&folder, None).ok()?;
    let out = place.folder.join("scene");
    let ingested = ingest(
        &capture,
        (Display::default(), None),
        &out,
        &tests::unwatched,
    );
    if ingested.is_ok() {
        check_names(&EngineScene::read(&out).expect("what was ingested is read"));
    }
    fs::remove_dir_all(out).ok()
}

/// Reads an ingested.json by any author.
pub fn ingested(place: &mut Place, input: &[u8]) -> Option<()> {
    place.write(&format!("scene/{INGESTED_FILE}"), input);
    let scene = EngineScene::read(&place.folder.join("scene")).ok()?;
    check_names(&scene);
    Some(())
}

/// Panics if a run would write anywhere except one folder of a scene, and in it one of the engine.
fn check_names(scene: &EngineScene) {
    for name in [&*scene.id.to_string(), scene.filter_name()] {
        let parts: Vec<Component> = Path::new(name).components().collect();
        let is_folder = matches!(parts.as_slice(), [Component::Normal(_)]);
        assert!(is_folder, "\"{name}\" is no name of a folder");
    }
}
