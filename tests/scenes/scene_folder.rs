//! Small scene in a temporary folder, which tests load and edit.

use std::path::PathBuf;

use frame::{Raster, write_png};
use tracer::{Scene, SceneError, load_scene};

pub const SCENE: &str = include_str!("../fixtures/square/scene.toml");
pub const OBJ: &str = include_str!("../fixtures/square/mesh.obj");
pub const MTL: &str = include_str!("../fixtures/square/mesh.mtl");

/// Temporary folder of a scene, deleted with the value.
pub struct Folder {
    _parent: tempfile::TempDir,
    /// Path of the scene.
    pub path: PathBuf,
}

impl Folder {
    /// Writes the scene to a new folder.
    pub fn new() -> Self {
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

    pub fn read(&self, file: &str) -> String {
        std::fs::read_to_string(self.path.join(file)).unwrap()
    }

    pub fn write(&self, file: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path.join(file), content).unwrap();
    }

    /// Replaces a text that a file contains once.
    pub fn edit(&self, file: &str, from: &str, to: &str) {
        let text = self.read(file);
        let count = text.matches(from).count();
        assert_eq!(count, 1, "\"{from}\" must stand once in {file}");
        self.write(file, text.replace(from, to));
    }

    pub fn load(&self) -> Result<Scene, SceneError> {
        load_scene(&self.path, None)
    }
}
