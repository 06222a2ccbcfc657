//! Packs that a run takes its truths from.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use frame::{read_exr, write_exr};
use suite::TRAVERSALS;
use tests::text::assert_contains;

use super::{QUICK, entries, packed, run};
use crate::sandbox::{Sandbox, assert_done, files_below, split, stderr, stdout};

/// Names of the files that a run renders.
fn is_rendered(name: &str) -> bool {
    let is_of = |folder: &str| name.contains(folder) && name.ends_with(".exr");
    name.ends_with("frame.exr") || is_of("truth_") || is_of("ladder_")
}

/// Reads all rendered files of a folder, by their names.
fn rendered(sandbox: &Sandbox, out: &str) -> BTreeMap<String, Vec<u8>> {
    let root = sandbox.path(out);
    let name = |path: &PathBuf| path.strip_prefix(&root).unwrap().display().to_string();
    files_below(&root)
        .into_iter()
        .filter(|path| is_rendered(&name(path)))
        .map(|path| (name(&path), fs::read(&path).unwrap()))
        .collect()
}

/// Writes into every rendered file that it was traced by the instructions of another machine. Nothing depends on them, and what is
/// rendered anew names others.
fn mark(sandbox: &Sandbox, out: &str) {
    for name in rendered(sandbox, out).into_keys() {
        let path = sandbox.path(out).join(name);
        let mut file = read_exr(&path).unwrap();
        let own = file.get::<String>("traversal").unwrap();
        let other = TRAVERSALS.into_iter().find(|word| *word != own);
        file.set("traversal", other.unwrap());
        write_exr(&path, &file).unwrap();
    }
}

/// Reads run.json without the command line, which names other folders.
fn scores(sandbox: &Sandbox, out: &str) -> String {
    let mut run: serde_json::Value = sandbox.read_json(&format!("{out}/run.json"));
    run["command"].take();
    run.to_string()
}

/// Filters of both shutters.
const FILTERS: &str = "identity,kino:default";

#[test]
fn a_check_from_a_pack_renders_nothing_and_has_the_same_scores() {
    let sandbox = Sandbox::two_scenes();
    sandbox.write_bound(1.0);
    sandbox.copy_bound("slow");
    let check = |more: &[&str]| {
        let words = [&["check", "--filter", FILTERS], &split(QUICK)[..], more].concat();
        let output = sandbox.outside_ci(&words);
        assert_done(&output);
        output
    };
    check(&[]);
    mark(&sandbox, "out");
    sandbox.execute(&["truths", "pack", "out", "--out", "kept/truths.tar.zst"]);
    fs::create_dir(sandbox.path("elsewhere")).unwrap();
    fs::rename(sandbox.path("kept"), sandbox.path("elsewhere/kept")).unwrap();
    let pack = "elsewhere/kept/truths.tar.zst";
    let output = check(&["--truths", pack, "--out", "fresh"]);
    assert_contains(
        &stderr(&output),
        &[pack, "traced 8 tiles again", "; nothing is rendered"],
    );
    // Each scene has a frame, two truths of eight replicates, and the sharp picture of the trailing shutter's middle.
    let kept = rendered(&sandbox, "out");
    assert_eq!(kept.len(), 2 * (1 + 2 * (1 + 8) + 1));
    assert!(
        kept == rendered(&sandbox, "fresh"),
        "a file was rendered again, or is another one"
    );
    assert_eq!(scores(&sandbox, "fresh"), scores(&sandbox, "out"));
    assert!(!sandbox.path("fresh/.shuttertruth.unpacked").exists());
    // A second check finds all of it in its folder.
    let output = check(&["--truths", pack, "--out", "fresh"]);
    let parts = ["took no file; nothing is rendered"];
    assert_contains(&stderr(&output), &parts);
}

#[test]
fn one_run_gives_one_archive_with_the_manifest_first() {
    let sandbox = packed();
    let first = fs::read(sandbox.path("truths.tar.zst")).unwrap();
    // Another folder, with files of another time.
    for file in files_below(&sandbox.path("out")) {
        let below = file.strip_prefix(sandbox.path("out")).unwrap();
        let to = sandbox.path("copy").join(below);
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::write(to, fs::read(&file).unwrap()).unwrap();
    }
    let printed = sandbox.execute(&["truths", "pack", "copy", "--out", "again.tar.zst"]);
    assert_contains(&printed, &["written: again.tar.zst", "1 truth in 17 files"]);
    assert!(fs::read(sandbox.path("again.tar.zst")).unwrap() == first);

    let entries = entries(&sandbox.path("truths.tar.zst"));
    let manifest: store::Manifest = serde_json::from_slice(&entries[0].bytes).unwrap();
    assert_eq!(entries[0].name, "manifest.json");
    assert_eq!(manifest.format, store::PACK_FORMAT);
    let names: Vec<&String> = entries[1..].iter().map(|entry| &entry.name).collect();
    let listed: Vec<&String> = manifest.files.iter().map(|file| &file.path).collect();
    assert_eq!(names, listed);
    let truth_hash = &sandbox.read_run().cases[0].truth_hash;
    for (file, entry) in manifest.files.iter().zip(&entries[1..]) {
        assert_eq!(file.bytes, entry.bytes.len() as u64);
        assert_eq!(file.blake3, blake3::hash(&entry.bytes).to_hex().to_string());
        assert_eq!(
            (file.scene.as_str(), file.width, file.height),
            ("plate", 64, 32)
        );
    }
    let truth = (manifest.files.iter()).find(|file| file.path == "plate/truth_trailing.exr");
    assert_eq!(&truth.unwrap().content_hash, truth_hash);
    assert_eq!(truth.unwrap().samples_per_pixel, 16);
}

#[test]
fn a_pack_of_chosen_scenes_leaves_the_others_to_be_rendered() {
    let sandbox = Sandbox::two_scenes();
    run(&sandbox, "identity", &[]);
    sandbox.execute(&["truths", "pack", "--scenes", "sl*"]);
    let words = "run --filter identity --truths truths.tar.zst --out fresh";
    let output = sandbox.shuttertruth(&[&split(words)[..], &split(QUICK)].concat());
    assert_done(&output);
    let parts = [
        "took 17 files, and traced 3 tiles again",
        "renders what it lacks: frame of plate, trailing truth of plate.",
    ];
    assert_contains(&stderr(&output), &parts);
    assert_eq!(scores(&sandbox, "fresh"), scores(&sandbox, "out"));
}

#[test]
fn truths_of_other_settings_stay_in_the_pack() {
    let sandbox = packed();
    let words = "run --filter identity --seed 2 --out";
    let run = |more: &[&str]| {
        let output = sandbox.shuttertruth(&[&split(words), more, &split(QUICK)].concat());
        assert_done(&output);
        stderr(&output)
    };
    let said = run(&["other", "--truths", "truths.tar.zst"]);
    let parts = ["took no file; renders what it lacks: frame of plate, trailing truth of plate"];
    assert_contains(&said, &parts);
    run(&["alone"]);
    assert_eq!(scores(&sandbox, "other"), scores(&sandbox, "alone"));
}

#[test]
fn later_frames_of_sequences_are_packed_too() {
    let sandbox = Sandbox::new();
    let sequence = "--filter identity --frames 2";
    run(&sandbox, "identity", &["--frames", "2"]);
    mark(&sandbox, "out");
    sandbox.execute(&["truths", "pack"]);
    let words = [&["run"], &split(sequence)[..], &split(QUICK)].concat();
    let more = ["--truths", "truths.tar.zst", "--out", "fresh"];
    let output = sandbox.shuttertruth(&[&words[..], &more].concat());
    assert_done(&output);
    assert_contains(&stderr(&output), &["; nothing is rendered"]);
    assert!(rendered(&sandbox, "fresh") == rendered(&sandbox, "out"));
    assert_eq!(scores(&sandbox, "fresh"), scores(&sandbox, "out"));
    let printed = sandbox.execute(&["truths", "verify", "truths.tar.zst"]);
    assert_contains(
        &printed,
        &["6 tiles of 16x16", "2 truths equal to the mean"],
    );
}

#[test]
fn plans_and_calibrations_take_packs() {
    let sandbox = packed();
    let words = [
        &["truths", "plan", "--filter", "identity"],
        &split(QUICK)[..],
    ]
    .concat();
    let plan = sandbox.execute(&[&words[..], &["--truths", "truths.tar.zst", "--json"]].concat());
    assert!(!plan.contains("truths/plate"), "they are in the pack");
    for line in plan.lines() {
        let job: serde_json::Value = serde_json::from_str(line).unwrap();
        let measures = job["arguments"][0] == "run";
        let inputs = job["inputs"].to_string();
        assert_eq!(inputs.contains("truths.tar.zst"), measures, "{line}");
    }
    let words = "limits calibrate --filter identity --size 64x32 --samples-per-pixel 16 --runs 2 --out seeds";
    let more = ["--truths", "truths.tar.zst"];
    let output = sandbox.shuttertruth(&[&split(words)[..], &more].concat());
    assert_done(&output);
    // The first of the two seeds is that of the pack. A calibration takes one rung of the ladder.
    let parts = [
        "took 11 files",
        "; nothing is rendered",
        "took no file; renders",
    ];
    assert_contains(&stderr(&output), &parts);
    assert!(stdout(&output).contains("seeds/plate.bounds.toml"));
}

#[test]
fn a_pack_removes_what_a_killed_one_left_and_nothing_else() {
    let sandbox = packed();
    let there = |name: &str| sandbox.path(name).exists();
    for name in [
        ".shuttertruth-killed.tmp",
        ".shuttertruth-notes",
        "kept.tmp",
    ] {
        fs::write(sandbox.path(name), "").unwrap();
    }
    sandbox.execute(&["truths", "pack"]);
    assert!(!there(".shuttertruth-killed.tmp"));
    assert!(there(".shuttertruth-notes") && there("kept.tmp"));
    fs::create_dir(sandbox.path("below")).unwrap();
    fs::write(sandbox.path("below/.shuttertruth-killed.tmp"), "").unwrap();
    sandbox.execute(&["truths", "pack", "--out", "below/truths.tar.zst"]);
    assert!(!there("below/.shuttertruth-killed.tmp"));
}
