//! Packs as a source of a run's truths.

use std::fs;

use frame::{read_exr, write_exr};
use suite::TRAVERSALS;
use tests::text::assert_contains;

use super::{QUICK, entries, manifest, packed, quick, run};
use crate::sandbox::{Files, Sandbox, assert_done, split, stderr};

/// Reads all rendered files of a folder.
fn rendered(sandbox: &Sandbox, out: &str) -> Files {
    let below = |(path, bytes): (std::path::PathBuf, Vec<u8>)| {
        let name = path.strip_prefix(out).ok()?.to_str().unwrap().to_owned();
        let is_of = |folder: &str| name.contains(folder) && name.ends_with(".exr");
        let is_rendered = name.ends_with("frame.exr") || is_of("truth_") || is_of("ladder_");
        is_rendered.then(|| (name.into(), bytes))
    };
    sandbox.read_files().into_iter().filter_map(below).collect()
}

/// Records in every rendered file that another machine's instructions traced it. Nothing depends on them, and new files name others.
fn mark(sandbox: &Sandbox, out: &str) {
    for (name, _) in rendered(sandbox, out) {
        let path = sandbox.path(out).join(name);
        let mut file = read_exr(&path).unwrap();
        let own = file.get::<String>("traversal").unwrap();
        let other = TRAVERSALS.into_iter().find(|word| *word != own);
        file.set("traversal", other.unwrap());
        write_exr(&path, &file).unwrap();
    }
}

/// Asserts that two runs differ at most in their command lines.
#[track_caller]
fn assert_same_scores(sandbox: &Sandbox, outs: [&str; 2]) {
    let [one, other] = outs.map(|out| sandbox.read_comparable(out));
    assert_eq!(one, other);
}

/// Runs with the truths of the pack; returns the messages.
fn run_from_pack(sandbox: &Sandbox, line: &str) -> String {
    let output = quick(sandbox, &format!("run {line} --truths truths.tar.zst"));
    assert_done(&output);
    stderr(&output)
}

#[test]
fn a_check_from_a_pack_renders_nothing_and_has_the_same_scores() {
    let sandbox = Sandbox::two_scenes();
    sandbox.write_bound(1.0);
    sandbox.copy_bound("slow");
    // Filters of both shutters.
    let check = |more: &str| {
        let line = format!("check --filter identity,kino:default {QUICK} {more}");
        let output = sandbox.outside_ci(&split(&line));
        assert_done(&output);
        stderr(&output)
    };
    check("");
    mark(&sandbox, "out");
    sandbox.done("truths pack out --out kept/truths.tar.zst");
    fs::create_dir(sandbox.path("elsewhere")).unwrap();
    fs::rename(sandbox.path("kept"), sandbox.path("elsewhere/kept")).unwrap();
    let pack = "elsewhere/kept/truths.tar.zst";
    let from_pack = format!("--truths {pack} --out fresh");
    let parts = [pack, "traced 8 tiles again", "; nothing is rendered"];
    assert_contains(&check(&from_pack), &parts);
    // Each scene has a frame, two truths of eight replicates, and the sharp picture of the trailing shutter's middle.
    let kept = rendered(&sandbox, "out");
    assert_eq!(kept.len(), 2 * (1 + 2 * (1 + 8) + 1));
    let fresh = rendered(&sandbox, "fresh");
    assert!(kept == fresh, "a file was rendered again or differs");
    assert_same_scores(&sandbox, ["fresh", "out"]);
    assert!(!sandbox.path("fresh/.shuttertruth.unpacked").exists());
    // A second check finds all of it in its folder.
    assert_contains(&check(&from_pack), &["took no file; nothing is rendered"]);
}

#[test]
fn one_run_gives_one_archive_with_the_manifest_first() {
    let sandbox = packed();
    let first = fs::read(sandbox.path("truths.tar.zst")).unwrap();
    // Another sandbox, with files of another time.
    let copy = packed();
    let printed = copy.done("truths pack out --out again.tar.zst");
    assert_contains(&printed, &["written: again.tar.zst", "1 truth in 17 files"]);
    assert!(fs::read(copy.path("again.tar.zst")).unwrap() == first);

    let entries = entries(&sandbox.path("truths.tar.zst"));
    let manifest = manifest(&entries);
    assert_eq!(entries[0].name, "manifest.json");
    assert_eq!(manifest.format, store::PACK_FORMAT);
    assert_eq!(manifest.files.len(), entries.len() - 1);
    for (file, entry) in manifest.files.iter().zip(&entries[1..]) {
        assert_eq!(file.path, entry.name);
        assert_eq!(file.bytes, entry.bytes.len() as u64);
        assert_eq!(file.blake3, blake3::hash(&entry.bytes).to_hex().to_string());
        assert_eq!(file.scene, "plate");
        assert_eq!([file.width, file.height], [64, 32]);
    }
    let mut files = manifest.files.iter();
    let truth = files.find(|file| file.path == "plate/truth_trailing.exr");
    let truth_hash = &sandbox.read_run().cases[0].truth_hash;
    assert_eq!(&truth.unwrap().content_hash, truth_hash);
    assert_eq!(truth.unwrap().samples_per_pixel, 16);
}

#[test]
fn a_pack_of_chosen_scenes_leaves_the_others_to_be_rendered() {
    let sandbox = Sandbox::two_scenes();
    run(&sandbox, "--filter identity");
    sandbox.done("truths pack --scenes sl*");
    let said = run_from_pack(&sandbox, "--filter identity --out fresh");
    let parts = "took 17 files, and traced 3 tiles again | \
        renders what it lacks: frame of plate, trailing truth of plate.";
    assert_contains(&said, &parts);
    assert_same_scores(&sandbox, ["fresh", "out"]);
}

#[test]
fn truths_of_other_settings_stay_in_the_pack() {
    let sandbox = packed();
    let said = run_from_pack(&sandbox, "--filter identity --seed 2 --out other");
    let part = "took no file; renders what it lacks: frame of plate, trailing truth of plate";
    assert_contains(&said, &[part]);
    run(&sandbox, "--filter identity --seed 2 --out alone");
    assert_same_scores(&sandbox, ["other", "alone"]);
}

#[test]
fn later_frames_of_sequences_are_packed_too() {
    let sandbox = Sandbox::new();
    let sequence = "--filter identity --frames 2";
    run(&sandbox, sequence);
    mark(&sandbox, "out");
    sandbox.done("truths pack");
    let said = run_from_pack(&sandbox, &format!("{sequence} --out fresh"));
    assert_contains(&said, &["; nothing is rendered"]);
    assert!(rendered(&sandbox, "fresh") == rendered(&sandbox, "out"));
    assert_same_scores(&sandbox, ["fresh", "out"]);
    let printed = sandbox.done("truths verify truths.tar.zst");
    let parts = ["6 tiles of 16x16", "2 truths equal to the mean"];
    assert_contains(&printed, &parts);
}

#[test]
fn plans_and_calibrations_take_packs() {
    let sandbox = packed();
    let line = "truths plan --filter identity --truths truths.tar.zst --json";
    let plan = sandbox.done(&format!("{line} {QUICK}"));
    assert!(!plan.contains("truths/plate"), "they are in the pack");
    for line in plan.lines() {
        let job: serde_json::Value = serde_json::from_str(line).unwrap();
        let measures = job["arguments"][0] == "run";
        let inputs = job["inputs"].to_string();
        assert_eq!(inputs.contains("truths.tar.zst"), measures, "{line}");
    }
    let words = "limits calibrate --filter identity --size 64x32 --samples-per-pixel 16 --runs 2 --out seeds";
    let output = sandbox.shuttertruth(&split(&format!("{words} --truths truths.tar.zst")));
    assert_done(&output);
    // The first of the two seeds is the pack's. A calibration uses one rung of the ladder.
    let parts = "took 11 files | ; nothing is rendered | took no file; renders";
    assert_contains(&stderr(&output), &parts);
    assert!(sandbox.path("seeds/plate.bounds.toml").is_file());
}

#[test]
fn a_pack_removes_what_a_killed_one_left_and_nothing_else() {
    let sandbox = packed();
    fs::create_dir(sandbox.path("below")).unwrap();
    let killed = [".shuttertruth-killed.tmp", "below/.shuttertruth-killed.tmp"];
    let others = [".shuttertruth-notes", "kept.tmp"];
    for name in killed.into_iter().chain(others) {
        sandbox.put(name, "");
    }
    sandbox.done("truths pack");
    sandbox.done("truths pack --out below/truths.tar.zst");
    assert!(killed.iter().all(|name| !sandbox.path(name).exists()));
    assert!(others.iter().all(|name| sandbox.path(name).exists()));
}
