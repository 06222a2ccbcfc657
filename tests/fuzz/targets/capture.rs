//! Captures of an engine: their description, and what `ingest` leaves for a run.

use std::ops::ControlFlow;
use std::path::{Component, Path};

use engine::{Capture, ingest};
use frame::{Display, Raster, write_exr};
use suite::{EngineScene, INGESTED_FILE};

use crate::place::Place;
use crate::seeds::Seed;
use crate::target::{Shape, Target};
use crate::tokens;

/// capture.toml, beside pictures of 16 x 16 pixels.
pub static CAPTURE: Target = Target {
    name: "capture",
    share: 300,
    batch: 100,
    shape: Shape::Text,
    tokens: NAMES,
    seeds: |_| Vec::new(),
    run: |place, input| {
        place.write("capture/capture.toml", input);
        write_pictures(place);
        let out = place.folder.join("scene");
        if let Ok(capture) = Capture::read(&place.folder.join("capture"), None)
            && ingest(&capture, (Display::default(), None), &out, &|_| {
                ControlFlow::Continue(())
            })
            .is_ok()
        {
            check_names(&EngineScene::read(&out).expect("what was ingested is read"));
        }
        let _ = std::fs::remove_dir_all(out);
    },
};

/// ingested.json, whoever wrote it.
pub static INGESTED: Target = Target {
    name: "ingested",
    share: 300,
    batch: 250,
    shape: Shape::Text,
    tokens: tokens::JSON,
    seeds: |_| {
        let names = NAMES.iter().map(|engine| format!("plate@{engine}"));
        let all = names.chain(["plate@three.js_0.187.0", "../up@engine"].map(str::to_owned));
        all.map(|name| Seed::Bytes(INGESTED_TEXT.replace("NAME", &name).into_bytes()))
            .collect()
    },
    run: |place, input| {
        place.write(&format!("scene/{INGESTED_FILE}"), input);
        if let Ok(scene) = EngineScene::read(&place.folder.join("scene")) {
            check_names(&scene);
        }
    },
};

/// Names of engines that no folder may have.
const NAMES: &[&str] = &[
    "..",
    ".",
    "../..",
    "../../canary.txt",
    "/dev/null",
    "a/b",
    "",
];

const INGESTED_TEXT: &str = r#"{
  "format": 1,
  "program": "shuttertruth",
  "name": "NAME",
  "engine": "Engine 1",
  "scene": null,
  "size": [16, 16],
  "exposure": 0.5,
  "alignment": "trailing",
  "subframes": 4,
  "step": 0.1,
  "ladder": [1],
  "has_picture": true,
  "hash": "0"
}"#;

/// Panics if a run would write elsewhere than into one folder of a scene, and in it one of the engine.
fn check_names(scene: &EngineScene) {
    for name in [&*scene.id.to_string(), scene.filter_name()] {
        let parts: Vec<Component> = Path::new(name).components().collect();
        assert!(
            matches!(parts.as_slice(), [Component::Normal(_)]),
            "\"{name}\" is no name of a folder"
        );
    }
}

/// Writes colour, velocity and depth of one instant.
fn write_pictures(place: &Place) {
    let path = |name: &str| place.folder.join("capture").join(name);
    if path("depth.exr").exists() {
        return;
    }
    for (name, planes) in [("color", 3), ("velocity", 2), ("depth", 1)] {
        let mut file = frame::ExrFile::new(16, 16);
        for channel in ["R", "G", "B"].into_iter().take(planes) {
            file.push_plane(
                channel,
                &Raster::from_fn(16, 16, |x, y| 1.0 + (x + y) as f32),
            );
        }
        write_exr(&path(&format!("{name}.exr")), &file).unwrap();
    }
    place.write("capture/engine.toml", "[convention]\n");
}
