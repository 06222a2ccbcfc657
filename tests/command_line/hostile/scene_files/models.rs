//! Broken models.

use std::fmt::Write as _;

use super::assert_render_refused;
use crate::sandbox::{MTL, OBJ, Sandbox};

#[test]
fn a_face_with_too_many_corners_is_refused() {
    let sandbox = Sandbox::new();
    let mut obj = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\nf");
    for corner in 0..40_000 {
        write!(obj, " {}", 1 + corner % 3).unwrap();
    }
    sandbox.write("plate.obj", &obj);
    let found = "f has 40000 corners; allowed: 3 to 4096; cut the face into triangles";
    assert_render_refused(&sandbox, &["plate.obj:4:", found]);
}

#[test]
fn odd_models_load_or_are_refused_and_never_panic() {
    let odd = [
        "",
        "\0",
        "f",
        "f 1",
        "f 1 2 3",
        "v",
        "v 1 2",
        "v 1e999 0 0",
        "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/ 2/ 3/",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1// 2// 3//",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1000000000 2 3",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no\ng\nf 3 2 1",
        "mtllib",
        "mtllib plate.obj\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
        "mtllib ../plate/plate.mtl\nmtllib plate.mtl",
        "mtllib /",
        "usemtl",
        "usemtl paint",
        "\u{feff}v 0 0 0",
        "v\u{2028}0 0 0",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3",
        "l 1 2 3\np 1\nvp 1 2\ncurv 0 1 1 2\nend",
        "v 0 0 0 nan nan nan\nv 1 0 0\nv 0 1 0\nf 1 2 3",
    ];
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
    for text in odd.into_iter().chain(long.iter().map(String::as_str)) {
        for (file, good) in [("plate.obj", OBJ), ("plate.mtl", MTL)] {
            for text in [
                text.to_owned(),
                format!("{good}{text}\n"),
                format!("{text}\n{good}"),
            ] {
                sandbox.write(file, &text);
                if let Err(error) = tracer::load_scene(&scene, None) {
                    let length = error.to_string().len();
                    assert!(length < 1_000, "a message of {length} bytes");
                }
            }
            sandbox.write(file, good);
        }
    }
}
