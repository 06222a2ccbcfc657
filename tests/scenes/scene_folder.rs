//! Small scene in a temporary folder, which tests load and edit.

use std::path::PathBuf;

use frame::{Raster, write_png};
use tracer::{Scene, SceneError, load_scene};

pub const SCENE: &str = r#"exposes = "A square that slides."
family = "translation"
exposure = 0.5
size = [64, 36]

[camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
vertical_fov = 40

[background]
constant = [0, 0, 0]

[sun]
direction = [0, 1, 0]
irradiance = [1, 1, 1]

[object.body]
mesh = "mesh.obj"
keys = [
    { time = -1 },
    { time = 1, translation = [1, 0, 0] },
]

[object.part]
mesh = "mesh.obj"
group = "left"
parent = "body"
scale = 2

[object.part.material.paint]
diffuse = [0.1, 0.2, 0.3]

[variant.fast.object.body]
keys = [
    { time = -1 },
    { time = 1, translation = [2, 0, 0] },
]
"#;

pub const OBJ: &str = "\
mtllib mesh.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v -1 0 0
v -1 1 0
vt 0 0
vt 1 0
vt 1 1
vn 0 0 2
g right
usemtl paint
f 1/1/1 2/2/1 3/3/1
f 1/1/1 3/3/1 4/2/1
g left
usemtl glow
f 1/1/1 4/2/1 6/3/1 5/2/1
usemtl paint
f 1/1/1 4/2/1 6/3/1
";

pub const MTL: &str = "\
newmtl paint
Kd 0.5 0.6 0.7
map_Kd dots.png
newmtl glow
Kd 0 0 0
Ke 1 2 3
d 0.25
";

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

    pub fn write(&self, file: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path.join(file), content).unwrap();
    }

    /// Replaces a text that a file contains once.
    pub fn edit(&self, file: &str, from: &str, to: &str) {
        let text = std::fs::read_to_string(self.path.join(file)).unwrap();
        assert_eq!(
            text.matches(from).count(),
            1,
            "\"{from}\" must stand once in {file}"
        );
        self.write(file, text.replace(from, to));
    }

    pub fn load(&self) -> Result<Scene, SceneError> {
        load_scene(&self.path, None)
    }
}
