//! Names of scenes: in all scripts, with an @, with odd characters.

use std::fs;

use frame::Frame;

use crate::sandbox::{SCENE, Sandbox};

const RENDER: &str = "truths render --quiet --out r --samples-per-pixel 16";

/// Makes a sandbox whose plate is in another folder.
fn with_plate_in(folder: &str) -> Sandbox {
    let sandbox = Sandbox::new();
    let target = sandbox.path(folder);
    fs::create_dir_all(target.parent().unwrap()).unwrap();
    fs::rename(sandbox.path("scenes/plate"), target).unwrap();
    sandbox
}

#[test]
fn names_in_every_script_are_written_as_utf_8() {
    for name in ["\u{e9}ventail", "\u{6247}\u{98a8}\u{6a5f}_\u{1f300}"] {
        let sandbox = with_plate_in(&format!("scenes/{name}"));
        sandbox.done(RENDER);
        let path = sandbox.path("r").join(name).join("frame.exr");
        assert_eq!(Frame::read(&path).unwrap().provenance.scene, name);
        let bytes = fs::read(&path).unwrap();
        let mut windows = bytes.windows(name.len());
        assert!(windows.any(|window| window == name.as_bytes()), "{name}");
    }
}

#[test]
fn a_folder_above_a_scene_may_contain_an_at_and_the_scene_may_not() {
    let sandbox = with_plate_in("me@home/plate");
    sandbox.done(&format!("{RENDER} --scenes ./me@home/plate"));
    let all = format!("{RENDER} --scenes ./me@home/plate@all");
    sandbox.refuse(&all, "./me@home/plate has no variants for @all");
    let sandbox = with_plate_in("me@home/plate@fast");
    let parts = ["plate@fast cannot name a scene", "names without @"];
    sandbox.refuse(&format!("{RENDER} --scenes-dir me@home"), &parts);
}

#[test]
fn a_path_with_at_all_selects_every_variant() {
    let sandbox = Sandbox::new();
    let variants = "[variant.short]\nexposure = 0.25\n[variant.long]\nexposure = 1.0\n";
    sandbox.write("scene.toml", &format!("{SCENE}\n{variants}"));
    sandbox.done(&format!("{RENDER} --scenes ./scenes/plate@all"));
    for variant in ["plate@short", "plate@long"] {
        assert!(sandbox.path("r").join(variant).join("frame.exr").is_file());
    }
}
