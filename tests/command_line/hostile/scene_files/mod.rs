//! Scene folders: manifests, broken models, textures small as files and huge when decoded.

mod files;
mod sizes;

use std::fs;

use crate::hostile::claims::{claims, png};
use crate::sandbox::{MTL, OBJ, SCENE, Sandbox, rows};

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

#[test]
fn small_pictures_that_decode_to_huge_ones_are_refused() {
    let sandbox = Sandbox::new();
    with_texture(&sandbox, "black.png");
    // One bit for each pixel, and a byte before each row.
    let black = png(16_384, 8_192, [1, 0], 8_192 * (1 + 16_384 / 8));
    assert!(black.len() < 50_000, "{} bytes", black.len());
    sandbox.put("scenes/plate/black.png", black);
    let found = "is 16384 x 8192, 134217728 texels; allowed: 1 to 67108864; scale it down";
    sandbox.refuse(RENDER, &["plate.mtl:3: texture", "black.png", found]);

    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30000 +X 60000\n".to_vec();
    let found = "is 60000 x 30000, 1800000000 texels".to_owned();
    let exr = claims("skies").into_iter();
    let exr = exr.map(|claim| ("sky.exr", claim.file(), claim.found));
    for (name, file, found) in exr.chain([("sky.hdr", hdr, found)]) {
        let sandbox = Sandbox::new();
        with_sky(&sandbox, name);
        fs::write(sandbox.path("scenes/plate").join(name), file).unwrap();
        sandbox.refuse(RENDER, &["scene.toml:12: the background's image", &found]);
    }
}

#[test]
fn a_face_with_too_many_corners_is_refused() {
    let sandbox = Sandbox::new();
    let face = "f".to_owned() + &" 1 2 3".repeat(13_334);
    sandbox.write("plate.obj", &format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{face}"));
    let found = "f has 40002 corners; allowed: 3 to 4096; cut the face into triangles";
    sandbox.refuse(RENDER, &["plate.obj:4:", found]);
}

#[test]
fn odd_models_load_or_are_refused_and_never_panic() {
    let long = [
        "v ".repeat(1_000_000),
        "f ".to_owned() + &"1/".repeat(1_000_000),
        "o ".to_owned() + &"x".repeat(1_000_000),
        "#".repeat(1_000_000),
        "1".repeat(1_000_000),
        "v ".to_owned() + &"1".repeat(1_000_000) + " 0 0",
    ];
    let sandbox = Sandbox::new();
    let scene = sandbox.path("scenes/plate");
    let odd = rows(include_str!("odd_models.toml"), "models").concat();
    for text in odd.into_iter().chain(long.iter().map(String::as_str)) {
        for (file, good) in [("plate.obj", OBJ), ("plate.mtl", MTL)] {
            let (before, after) = (format!("{text}\n{good}"), format!("{good}{text}\n"));
            for text in [text, &before, &after] {
                sandbox.write(file, text);
                if let Err(error) = tracer::load_scene(&scene, None) {
                    let length = error.to_string().len();
                    assert!(length < 1_000, "a message of {length} bytes");
                }
            }
            sandbox.write(file, good);
        }
    }
}
