//! Scenes: reading and refusing folders, and the shipped scenes.

mod appearance;
mod built_in;
mod catalogue;
mod coincident;
#[path = "../../crates/engine/tests/library/mod.rs"]
mod engine;
mod frame_rates;
mod given_variants;
mod reading;
mod refusals;

use std::path::PathBuf;

use frame::{Raster, write_png};
use scene::{Scene, SceneError, list_scenes, load_scene};
use tests::scenes;

/// Loads a shipped scene, `name` or `name@variant`.
fn load_shipped(name: &str) -> Scene {
    let (name, variant) = match name.split_once('@') {
        Some((name, variant)) => (name, Some(variant)),
        None => (name, None),
    };
    load_scene(scenes().join(name), variant).unwrap_or_else(|error| panic!("{error}"))
}

/// Lists the names of all shipped scenes.
fn shipped() -> Vec<String> {
    let listings = list_scenes(scenes()).unwrap_or_else(|error| panic!("{error}"));
    listings.into_iter().map(|listing| listing.name).collect()
}

/// Lists them with all their variants, `name@variant`.
fn shipped_with_variants() -> Vec<String> {
    let listings = list_scenes(scenes()).unwrap().into_iter();
    let all = listings.flat_map(|listing| {
        let of = |variant: &String| format!("{}@{variant}", listing.name);
        let variants: Vec<String> = listing.variants.iter().map(of).collect();
        std::iter::once(listing.name).chain(variants)
    });
    all.collect()
}

const SCENE: &str = include_str!("../fixtures/square/scene.toml");
const OBJ: &str = include_str!("../fixtures/square/mesh.obj");
const MTL: &str = include_str!("../fixtures/square/mesh.mtl");

/// Temporary folder of a scene, deleted with the value.
struct Folder {
    _parent: tempfile::TempDir,
    /// Path of the scene.
    pub path: PathBuf,
}

impl Folder {
    /// Writes the scene to a new folder.
    fn new() -> Self {
        let parent = tempfile::tempdir().unwrap();
        let folder = Self {
            path: parent.path().join("square"),
            _parent: parent,
        };
        std::fs::create_dir(&folder.path).unwrap();
        folder.write("scene.toml", SCENE);
        folder.write("mesh.obj", OBJ);
        folder.write("mesh.mtl", MTL);
        let dots = Raster {
            width: 2,
            height: 1,
            pixels: vec![[0.5, 0.0, 1.0], [1.0, 1.0, 1.0]],
        };
        write_png(&folder.path.join("dots.png"), &dots).unwrap();
        folder
    }

    fn read(&self, file: &str) -> String {
        std::fs::read_to_string(self.path.join(file)).unwrap()
    }

    fn write(&self, file: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path.join(file), content).unwrap();
    }

    /// Replaces a text that a file contains once.
    fn edit(&self, file: &str, from: &str, to: &str) {
        let text = self.read(file);
        let count = text.matches(from).count();
        assert_eq!(count, 1, "\"{from}\" must stand once in {file}");
        self.write(file, text.replace(from, to));
    }

    fn load(&self) -> Result<Scene, SceneError> {
        load_scene(&self.path, None)
    }
}
