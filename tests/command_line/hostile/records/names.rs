//! Names of scenes: in every script, with an @, with odd characters.

use std::fs;

use frame::Frame;

use crate::sandbox::{Sandbox, assert_done, assert_refused};

const RENDER: [&str; 7] = [
    "truths",
    "render",
    "--quiet",
    "--out",
    "r",
    "--samples-per-pixel",
    "16",
];

/// Renames the plate's folder.
fn rename_scene(sandbox: &Sandbox, folder: &str) {
    let target = sandbox.path(folder);
    fs::create_dir_all(target.parent().unwrap()).unwrap();
    fs::rename(sandbox.path("scenes/plate"), target).unwrap();
}

#[test]
fn names_in_every_script_are_written_as_utf_8() {
    for name in ["\u{e9}ventail", "\u{6247}\u{98a8}\u{6a5f}_\u{1f300}"] {
        let sandbox = Sandbox::new();
        rename_scene(&sandbox, &format!("scenes/{name}"));
        sandbox.execute(&RENDER);
        let path = sandbox.path("r").join(name).join("frame.exr");
        assert_eq!(Frame::read(&path).unwrap().provenance.scene, name);
        let bytes = fs::read(&path).unwrap();
        let utf_8 = |window: &[u8]| window == name.as_bytes();
        assert!(bytes.windows(name.len()).any(utf_8), "{name}");
    }
}

#[test]
fn a_folder_above_a_scene_may_contain_an_at_and_the_scene_may_not() {
    let sandbox = Sandbox::new();
    rename_scene(&sandbox, "me@home/plate");
    let scene = |path: &str| sandbox.shuttertruth(&[&RENDER[..], &["--scenes", path]].concat());
    assert_done(&scene("./me@home/plate"));
    assert_refused(
        &scene("./me@home/plate@all"),
        2,
        &["./me@home/plate has no variants for @all"],
    );
    fs::rename(
        sandbox.path("me@home/plate"),
        sandbox.path("me@home/plate@fast"),
    )
    .unwrap();
    let words = [&RENDER[..], &["--scenes-dir", "me@home"]].concat();
    assert_refused(
        &sandbox.shuttertruth(&words),
        2,
        &["plate@fast cannot name a scene", "names without @"],
    );
}

#[test]
fn a_path_with_at_all_selects_every_variant() {
    let sandbox = Sandbox::new();
    let text = fs::read_to_string(sandbox.path("scenes/plate/scene.toml")).unwrap();
    sandbox.write(
        "scene.toml",
        &format!("{text}\n[variant.short]\nexposure = 0.25\n[variant.long]\nexposure = 1.0\n"),
    );
    let words = [&RENDER[..], &["--scenes", "./scenes/plate@all"]].concat();
    sandbox.execute(&words);
    for variant in ["plate@short", "plate@long"] {
        assert!(sandbox.path("r").join(variant).join("frame.exr").is_file());
    }
}
