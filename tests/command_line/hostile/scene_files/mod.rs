//! Scene folders: manifests, models, textures.

mod files;
mod headers;
mod models;
mod sizes;

use crate::sandbox::{SCENE, Sandbox, assert_refused};

/// Loads the plate's scene in a process of its own, which renders as little as possible.
#[track_caller]
fn assert_render_refused(sandbox: &Sandbox, parts: &[&str]) {
    assert_refused(&render(sandbox), 2, parts);
}

fn render(sandbox: &Sandbox) -> std::process::Output {
    let words =
        "truths render --quiet --scenes plate --size 16x16 --samples-per-pixel 16 --out out";
    sandbox.shuttertruth(&crate::sandbox::split(words))
}

fn with_texture(sandbox: &Sandbox, name: &str) {
    sandbox.write(
        "plate.mtl",
        &format!("newmtl paint\nKd 1 1 1\nmap_Kd {name}\n"),
    );
    sandbox.write("plate.obj", TEXTURED);
}

fn with_sky(sandbox: &Sandbox, name: &str) {
    let sky = format!("image = \"{name}\"");
    sandbox.write(
        "scene.toml",
        &SCENE.replace("constant = [0.2, 0.2, 0.2]", &sky),
    );
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
