//! Scene folders: manifests, models, textures.

mod files;
mod headers;
mod models;
mod sizes;

use crate::bench::{Bench, SCENE, assert_refused};

/// Loads the plate's scene in a process of its own, which renders as little as possible.
#[track_caller]
fn assert_render_refused(bench: &Bench, parts: &[&str]) {
    assert_refused(&render(bench), 2, parts);
}

fn render(bench: &Bench) -> std::process::Output {
    let words =
        "truths render --quiet --scenes plate --size 16x16 --samples-per-pixel 16 --out out";
    bench.shuttertruth(&crate::bench::split(words))
}

fn with_texture(bench: &Bench, name: &str) {
    bench.write(
        "plate.mtl",
        &format!("newmtl paint\nKd 1 1 1\nmap_Kd {name}\n"),
    );
    bench.write("plate.obj", TEXTURED);
}

fn with_sky(bench: &Bench, name: &str) {
    let sky = format!("image = \"{name}\"");
    bench.write(
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
