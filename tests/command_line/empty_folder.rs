//! The program in a folder without scenes: it brings its own along.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use tests::{root, scenes};
use tracer::{Location, load_scene};

use crate::sandbox::{Sandbox, assert_done, assert_refused, files_below, split, stdout};

const QUICK: &str = "--scenes fan --filter velocity_gather --size 32x18 --samples-per-pixel 16";

fn execute(folder: &Path, line: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_shuttertruth"));
    let command = command.current_dir(folder).args(split(line));
    command.env_remove("CI").output().unwrap()
}

/// Reads a run without the command that made it.
fn read_run(path: &Path) -> Value {
    let mut run: Value = serde_json::from_slice(&fs::read(path).unwrap()).unwrap();
    run.as_object_mut().unwrap().remove("command").unwrap();
    run
}

#[test]
fn a_run_in_an_empty_folder_equals_one_with_the_folder_of_scenes() {
    let folder = tempfile::tempdir().unwrap();
    assert_done(&execute(
        folder.path(),
        &format!("run --quiet {QUICK} --out own"),
    ));
    let on_disk = format!(
        "run --quiet {QUICK} --out disk --scenes-dir {}",
        scenes().display()
    );
    assert_done(&execute(folder.path(), &on_disk));
    let [own, disk] = ["own", "disk"].map(|name| folder.path().join(name));
    assert_eq!(
        read_run(&own.join("run.json")),
        read_run(&disk.join("run.json"))
    );
    // The truth's file holds the hash of its inputs.
    let truth = |out: &PathBuf| fs::read(out.join("fan/truth_trailing.exr")).unwrap();
    assert!(truth(&own) == truth(&disk), "the truths differ");
}

#[test]
fn other_commands_work_in_an_empty_folder() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let listed = execute(path, "list scenes");
    assert_done(&listed);
    assert!(stdout(&listed).contains("railing: "), "{}", stdout(&listed));
    assert_done(&execute(path, "engine export fan"));
    assert!(path.join("out/gltf/fan/scene.gltf").is_file());
    assert_done(&execute(
        path,
        "truths render --quiet --scenes fan@all --size 32x18 --samples-per-pixel 16",
    ));
    // The limits come along as well.
    let refused = execute(
        path,
        "check --scenes fan --filter velocity_gather --quiet --size 32x18 --out checked",
    );
    assert_eq!(refused.status.code(), Some(2));
    let checked = execute(
        path,
        "check --scenes fan --filter mcguire:paper --quiet --out checked",
    );
    assert_done(&checked);
    assert!(stdout(&checked).ends_with("PASS\n"), "{}", stdout(&checked));
}

#[test]
fn a_folder_of_scenes_goes_before_the_program_s_own() {
    let sandbox = Sandbox::new();
    let names = |words: &[&str]| -> Vec<String> {
        let json: Value = serde_json::from_str(&sandbox.execute(words)).unwrap();
        let scenes = json["scenes"].as_array().unwrap().iter();
        scenes
            .map(|scene| scene["name"].as_str().unwrap().to_owned())
            .collect()
    };
    assert_eq!(names(&["list", "scenes", "--json"]), ["plate"]);
    let own = names(&["list", "scenes", "--json", "--scenes-dir", "built-in"]);
    assert!(own.len() > 20 && own.contains(&"fan".to_owned()), "{own:?}");
    assert_refused(
        &sandbox.run(&["--scenes", "fan"]),
        2,
        &["no scene \"fan\" in scenes", "--scenes-dir built-in"],
    );
    assert_refused(
        &sandbox.run(&["--scenes-dir", "nowhere"]),
        2,
        &["nowhere: there is no such folder of scenes"],
    );
}

#[test]
fn the_program_s_own_scenes_are_those_of_the_repository() {
    let own = Location::of_bundle(&catalogue::SCENES);
    let mut names = (catalogue::SCENES.list)();
    for path in files_below(&scenes()) {
        let name = path
            .strip_prefix(scenes())
            .unwrap()
            .to_str()
            .unwrap()
            .replace('\\', "/");
        let folder = name.split_once('/').map_or("", |(folder, _)| folder);
        if name != "bounds.toml" && !scenes().join(folder).join("scene.toml").is_file() {
            continue;
        }
        let bytes = own.join(&name).read(1 << 30).unwrap();
        assert!(
            bytes == fs::read(&path).unwrap(),
            "{name} differs from the file"
        );
        names.retain(|own| *own != name);
    }
    assert!(names.is_empty(), "not in the repository: {names:?}");
    let hash = |folder: Location| load_scene(folder, None).unwrap().hash;
    assert_eq!(hash(own.join("fan")), hash(scenes().join("fan").into()));
}

#[test]
fn a_path_out_of_the_program_s_own_scenes_leads_nowhere() {
    let own = Location::of_bundle(&catalogue::SCENES);
    for path in [
        "../Cargo.toml",
        "/etc/hostname",
        "fan/../../Cargo.toml",
        "fan",
        "no/scene.toml",
    ] {
        let message = own.join(path).read(1 << 20).unwrap_err().to_string();
        assert!(message.contains("cannot read"), "{path}: {message}");
    }
    assert!(own.join("fan").is_dir() && !own.join("fa").is_dir() && !own.join("fan").is_file());
    let message = own.join("fan/scene.toml").read(9).unwrap_err().to_string();
    assert!(message.contains("allowed: up to 9"), "{message}");
    assert!(root().join("Cargo.toml").is_file());
}
