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
    sandbox.write("plate.obj", TEXTURED);
}

fn with_sky(sandbox: &Sandbox, name: &str) {
    let sky = format!("image = \"{name}\"");
    let scene = SCENE.replace("constant = [0.2, 0.2, 0.2]", &sky);
    sandbox.write("scene.toml", &scene);
}

const TEXTURED: &str = "\
mtllib plate.mtl
v -0.5 -0.5 0
v 0.5 -0.5 0
v 0.5 0.5 0
vt 0 0
vt 1 0
vt 1 1
usemtl paint
f 1/1 2/2 3/3
";
