//! The program in a folder without scenes: it includes its own.

use std::fs;
use std::process::Command;

use scene::{Location, load_scene};
use serde_json::Value;
use tests::{root, scenes};

use crate::sandbox::{Sandbox, assert_same_files, files_below, read_below, split};

const QUICK: &str = "--scenes fan --filter velocity_gather --size 32x18 --samples-per-pixel 16";

/// Makes a sandbox without scenes.
fn empty() -> Sandbox {
    Sandbox::of(&Vec::new())
}

#[test]
fn a_run_in_an_empty_folder_equals_one_with_the_folder_of_scenes() {
    let sandbox = empty();
    let folder = scenes().display().to_string();
    let disk = format!("--scenes-dir {folder}");
    let [bundle, disk] = [("own", ""), ("disk", &disk)].map(|(out, more)| {
        sandbox.done(&format!("run --quiet {QUICK} --out {out} {more}"));
        // The truth's file contains the hash of its inputs.
        let truth = sandbox.path(out).join("fan/truth_trailing.exr");
        (sandbox.read_comparable(out), fs::read(truth).unwrap())
    });
    assert_eq!(bundle.0, disk.0);
    assert!(bundle.1 == disk.1, "the truths differ");
}

#[test]
fn other_commands_work_in_an_empty_folder() {
    let sandbox = empty();
    assert!(sandbox.done("list scenes").contains("railing: "));
    sandbox.done("engine export fan");
    assert!(sandbox.path("out/gltf/fan/scene.gltf").is_file());
    let render = "truths render --quiet --scenes fan@all --size 16x16 --samples-per-pixel 16";
    sandbox.done(render);
    // The limits are included as well, for the scene's own size.
    sandbox.refuse(
        "check --quiet --scenes fan --filter mcguire:paper --out checked --size 32x18",
        &["built-in/fan/bounds.toml:39: the limit on bleed_lateral holds for 160x90"],
    );
}

/// [`other_commands_work_in_an_empty_folder`] reads the limits, too.
#[test]
#[ignore = "prove: a check at the size of the limits"]
fn a_check_in_an_empty_folder_is_judged_by_the_limits_that_come_along() {
    let sandbox = empty();
    let printed = sandbox.done("check --quiet --scenes sliding_panel --filter mcguire:paper --size 160x90 --samples-per-pixel 64");
    assert!(printed.contains("14 required bounds: 14 met"), "{printed}");
    let judgement: Value = sandbox.read_json("out/judgement.json");
    let place = judgement["findings"][0]["place"].as_str().unwrap();
    let begin = "built-in/sliding_panel/bounds.toml:";
    assert!(place.starts_with(begin), "{place}");
}

#[test]
fn the_program_s_own_scenes_are_those_of_the_repository() {
    let bundle = Location::of_bundle(&catalogue::SCENES);
    let mut names = (catalogue::SCENES.list)();
    for path in files_below(&scenes()) {
        let name = path.strip_prefix(scenes()).unwrap().to_str();
        let name = name.unwrap().replace('\\', "/");
        let folder = name.split_once('/').map_or("", |(folder, _)| folder);
        if name != "bounds.toml" && !scenes().join(folder).join("scene.toml").is_file() {
            continue;
        }
        let bytes = bundle.join(&name).read(1 << 30).unwrap();
        assert!(bytes == fs::read(&path).unwrap(), "{name} differs");
        names.retain(|listed| *listed != name);
    }
    assert!(names.is_empty(), "not in the repository: {names:?}");
    let hash = |folder: Location| load_scene(folder, None).unwrap().hash;
    assert_eq!(hash(bundle.join("fan")), hash(scenes().join("fan").into()));
}

#[test]
fn copied_scenes_are_those_of_the_program_and_nothing_is_overwritten() {
    let sandbox = empty();
    let text = sandbox.done("list fan rail* --copy-to scenes");
    assert_eq!(text, "written: scenes (2 scenes)\n");
    let copied = read_below(&sandbox.path("scenes"));
    let expected = ["fan", "railing", "bounds.toml"];
    let mut shipped = read_below(&scenes());
    shipped.retain(|(name, _)| {
        expected
            .iter()
            .any(|name_begin| name.starts_with(name_begin))
    });
    assert_same_files(&copied, &shipped);
    // The user's own limits are kept.
    let bounds = sandbox.path("scenes/bounds.toml");
    fs::write(&bounds, "# mine\n").unwrap();
    sandbox.refuse("list fan two_spheres --copy-to scenes", &["fan exists"]);
    assert!(!sandbox.path("scenes/two_spheres").exists());
    let text = sandbox.done("list two_spheres --copy-to scenes");
    assert!(text.starts_with("kept: scenes"), "{text}");
    assert_eq!(fs::read_to_string(bounds).unwrap(), "# mine\n");
    // Every command finds the copied scenes.
    let listed = sandbox.done("list scenes");
    assert!(listed.contains("two_spheres") && !listed.contains("fence"));
    sandbox.refuse("list fann --copy-to scenes", &["did you mean fan?"]);
}

#[cfg(unix)]
#[test]
fn a_killed_copy_leaves_no_half_scene_and_does_not_block_the_next() {
    let sandbox = empty();
    // The system kills a program that writes a larger file than the shell allows, here 8 KiB.
    let line = "ulimit -f 8; exec \"$0\" list --copy-to scenes fan";
    let program = env!("CARGO_BIN_EXE_shuttertruth");
    let mut shell = Command::new("bash");
    shell
        .current_dir(sandbox.path(""))
        .args(["-c", line, program]);
    assert!(!shell.output().unwrap().status.success());
    assert!(!sandbox.path("scenes/fan").exists());
    sandbox.done("list fan --copy-to scenes");
    let copied = read_below(&sandbox.path("scenes/fan"));
    assert_same_files(&copied, &read_below(&scenes().join("fan")));
    assert!(!sandbox.done("list scenes").contains("shuttertruth-"));
}

#[test]
fn a_path_out_of_the_program_s_own_scenes_leads_nowhere() {
    let bundle = Location::of_bundle(&catalogue::SCENES);
    for path in split("../Cargo.toml /etc/hostname fan/../../Cargo.toml fan no/scene.toml") {
        let message = bundle.join(path).read(1 << 20).unwrap_err().to_string();
        assert!(message.contains("cannot read"), "{path}: {message}");
    }
    assert!(
        bundle.join("fan").is_dir() && !bundle.join("fa").is_dir() && !bundle.join("fan").is_file()
    );
    let message = bundle
        .join("fan/scene.toml")
        .read(9)
        .unwrap_err()
        .to_string();
    assert!(message.contains("allowed: up to 9"), "{message}");
    assert!(root().join("Cargo.toml").is_file());
}
