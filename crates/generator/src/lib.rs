//! Makes the meshes and textures of the built-in scenes. The scene.toml files beside them are written by hand.
//!
//! Everything is a pure function of nothing: the same bytes each time.

mod aeroplane;
mod car;
mod cuboid;
mod fan;
mod hash;
mod hills;
mod mesh;
mod panel;
mod railing;
mod revolution;
mod road;
mod sphere;
mod texture;
mod wall;
mod wheel;

/// A file of a built-in scene.
pub struct File {
    /// Below the folder of scenes: `fan/fan.obj`.
    pub path: String,
    /// What it holds.
    pub bytes: Vec<u8>,
}

/// Every generated file of every scene.
pub fn files() -> Vec<File> {
    [
        scene("sliding_panel", &[panel::files(), wall::plain()]),
        scene("panel_over_texture", &[panel::files(), wall::patchwork()]),
        scene("two_spheres", &[sphere::files()]),
        scene("fan", &[fan::files(), wall::brick()]),
        scene(
            "railing",
            &[
                aeroplane::files(),
                car::files(),
                hills::files(),
                railing::files(),
                road::files(),
                wheel::files(),
            ],
        ),
    ]
    .concat()
    .into_iter()
    .map(|(path, bytes)| File { path, bytes })
    .collect()
}

/// Name and content of files that belong together.
type Files = Vec<(String, Vec<u8>)>;

/// Puts files into a scene's folder.
fn scene(name: &str, parts: &[Files]) -> Files {
    parts
        .concat()
        .into_iter()
        .map(|(file, bytes)| (format!("{name}/{file}"), bytes))
        .collect()
}

/// The OBJ file of a mesh and its MTL file.
fn model(name: &str, mesh: &mesh::Mesh, materials: &str) -> Files {
    vec![
        (
            format!("{name}.obj"),
            mesh.obj(&format!("{name}.mtl")).into_bytes(),
        ),
        (format!("{name}.mtl"), materials.into()),
    ]
}
