//! Scenes with meshes of the size of well-known ones, written to a folder so that other renderers
//! can draw them, too.

use std::fs;
use std::path::{Path, PathBuf};

use scene::Mesh;

use crate::made_scene::bumpy_sphere;

const SCENES: [(&str, &str); 3] = [
    ("under_sky", include_str!("scenes/under_sky.toml")),
    ("under_lamp", include_str!("scenes/under_lamp.toml")),
    ("moving_camera", include_str!("scenes/moving_camera.toml")),
];

const SURFACES: &str = "newmtl grey\nKd 0.6 0.6 0.6\nnewmtl light\nKd 0 0 0\nKe 12 11 9\n";

/// A horizontal square that faces up.
const FLOOR: &str =
    "mtllib surfaces.mtl\nv -8 0 8\nv 8 0 8\nv 8 0 -8\nv -8 0 -8\nusemtl grey\nf 1 2 3 4\n";

/// A horizontal square that faces down.
const LAMP: &str = "mtllib surfaces.mtl\nv -0.4 0 0.4\nv -0.4 0 -0.4\nv 0.4 0 -0.4\nv 0.4 0 0.4\nusemtl light\nf 1 2 3 4\n";

/// Writes the scenes; returns their folders.
pub fn write_scenes() -> Vec<PathBuf> {
    let parent = Path::new(env!("CARGO_TARGET_TMPDIR")).join("price");
    let write = |(name, toml): (&str, &str)| {
        let folder = parent.join(name);
        fs::create_dir_all(&folder).expect("the target folder can be written");
        let files = [
            ("scene.toml", toml.to_owned()),
            ("surfaces.mtl", SURFACES.to_owned()),
            ("floor.obj", FLOOR.to_owned()),
            ("lamp.obj", LAMP.to_owned()),
            ("blob_130.obj", obj_text(&bumpy_sphere(130))),
            ("blob_39.obj", obj_text(&bumpy_sphere(39))),
        ];
        for (file, text) in files {
            fs::write(folder.join(file), text).expect("the target folder can be written");
        }
        folder
    };
    SCENES.into_iter().map(write).collect()
}

fn obj_text(mesh: &Mesh) -> String {
    let mut text = String::from("mtllib surfaces.mtl\nusemtl grey\n");
    for [x, y, z] in mesh.positions.iter().map(|point| point.to_array()) {
        text += &format!("v {x} {y} {z}\n");
    }
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|corner| corner + 1);
        text += &format!("f {a} {b} {c}\n");
    }
    text
}
