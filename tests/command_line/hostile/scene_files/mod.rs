//! Scene folders: manifests, models, textures.

mod contents;
mod files;
mod sizes;

use crate::sandbox::{SCENE, Sandbox};

/// Renders as little of the plate as possible, in its own process.
const RENDER: &str =
    "truths render --quiet --scenes plate --size 16x16 --samples-per-pixel 16 --out out";

fn with_texture(sandbox: &Sandbox, name: &str) {
    let mtl = format!("newmtl paint\nKd 1 1 1\nmap_Kd {name}\n");
    sandbox.write("plate.mtl", &mtl);
    let textured = include_str!("../../../fixtures/models/textured.obj");
    sandbox.write("plate.obj", textured);
}

fn with_sky(sandbox: &Sandbox, name: &str) {
    let sky = format!("image = \"{name}\"");
    let scene = SCENE.replace("constant = [0.2, 0.2, 0.2]", &sky);
    sandbox.write("scene.toml", &scene);
}
