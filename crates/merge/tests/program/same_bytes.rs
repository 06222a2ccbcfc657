//! Parts of a run, measured one by one and merged, against one process.

use std::fs;

use super::runs::{QUICK, parts};
use crate::sandbox::{Files, Sandbox, assert_same_files, read_below};

/// Reads all files of a run except the jobs' own, its judgement, and pages with their record.
fn contents(sandbox: &Sandbox, out: &str) -> Files {
    let mut files = read_below(&sandbox.path(out));
    files.retain(|(name, _)| {
        let text = name.to_string_lossy();
        let is_own = text.starts_with("parts/") || text.contains(".shuttertruth");
        let is_page = text == "page.json" || text.ends_with(".html");
        !is_own && !is_page && text != "judgement.json"
    });
    files
}

/// Measures every filter on every scene by itself in one sandbox and all of them at once in
/// another, with the same options; compares all files.
#[track_caller]
fn assert_parts_equal_one_process(scenes: &str, filters: &str, common: &str, options: &str) {
    let [shared, alone] = [(); 2].map(|()| Sandbox::two_scenes());
    let options = format!("{QUICK} {options}");
    let mut parts = String::new();
    for scene in scenes.split(',') {
        let references = format!("parts/{scene}");
        let run = format!("run {options} --common {common} --scenes {scene}");
        shared.done(&format!(
            "{run} --part references --filter {filters} --out {references}"
        ));
        parts += &format!(" {references}");
        for (index, filter) in filters.split(',').enumerate() {
            let part = format!("parts/{scene}_{index}");
            let words = format!("--part filters --filter {filter} --truths {references}");
            shared.done(&format!("{run} {words} --out {part}"));
            parts += &format!(" {part}");
        }
    }
    let whole = format!("run {options} --scenes {scenes} --filter {filters}");
    let program = env!("CARGO_BIN_EXE_shuttertruth");
    shared.done(&format!(
        "truths merge --quiet{parts} --out out -- {program} {whole}"
    ));
    shared.done("report --quiet out");
    alone.done(&whole);
    assert!(alone.path("out/run.json").is_file());
    assert_same_files(&contents(&shared, "out"), &contents(&alone, "out"));
}

#[test]
fn parts_of_a_run_make_the_files_of_one_process() {
    assert_parts_equal_one_process("plate", "kino:default", "centred", "--intervals");
}

#[test]
#[ignore = "prove: the parts of a run are joined in each test run"]
fn parts_of_two_scenes_make_the_files_of_one_process() {
    assert_parts_equal_one_process("plate,slow", "kino:default", "centred", "--intervals");
}

#[test]
#[ignore = "prove: the parts of a run are joined in each test run"]
fn parts_of_a_sequence_make_the_files_of_one_process() {
    assert_parts_equal_one_process("plate", "kino:default,identity", "centred", "--frames 2");
}

#[test]
#[ignore = "prove: the parts of a run are joined in each test run"]
fn parts_of_frame_rates_make_the_files_of_one_process() {
    let rates = "--frame-rate 24 --shutter-time 1/48 --input rule=in_frames";
    assert_parts_equal_one_process("plate", "identity", "trailing", rates);
}

#[test]
fn scenes_measured_by_themselves_are_joined() {
    let sandbox = parts();
    let printed = sandbox.done("truths merge plate slow --out both");
    assert_eq!(printed, "both/run.json (16 cases of 2 parts)\n");
    sandbox.done(&format!("run {QUICK} --filter identity --out out"));
    // A repeated part changes nothing.
    sandbox.done("truths merge plate slow plate --out twice");
    let [both, out, twice] = ["both", "out", "twice"].map(|out| sandbox.read_comparable(out));
    assert_eq!(both, out);
    assert_eq!(twice, both);
    sandbox.done("report both");
    let [both, out] = ["both", "out"].map(|out| {
        let mut files = contents(&sandbox, out);
        // It names the command.
        files.retain(|(name, _)| !name.ends_with("run.json"));
        files
    });
    assert_same_files(&both, &out);
}

#[test]
fn truths_of_another_folder_are_taken_if_their_inputs_are_the_same() {
    let sandbox = Sandbox::new();
    let size = "--quiet --scenes plate --size 64x32 --samples-per-pixel 16";
    sandbox.done(&format!("truths render {size} --ladders --out kept"));
    let with = |line: &str| sandbox.done(&format!("run {QUICK} --filter identity --out {line}"));
    with("same --truths kept");
    for name in ["frame.exr", "truth_trailing.exr", "ladder_trailing/n64.exr"] {
        let files = ["kept", "same"].map(|out| format!("{out}/plate/{name}"));
        let [kept, taken] = files.map(|file| sandbox.written(&file));
        assert_eq!(kept, taken, "{name} was rendered again");
    }
    let truth =
        |out: &str| fs::read(sandbox.path(&format!("{out}/plate/truth_trailing.exr"))).unwrap();
    let before = truth("kept");
    with("other --truths kept --seed 2");
    with("alone --seed 2");
    assert!(truth("other") != before, "another seed's was taken");
    assert!(truth("other") == truth("alone"));
    // New results in one folder leave the other unchanged.
    with("same --seed 2");
    assert!(truth("kept") == before);
}

#[test]
fn a_part_holds_its_references_or_its_filters_and_has_no_report() {
    let sandbox = parts();
    let references = "--filter identity --part references --out bars";
    sandbox.done(&format!("run {QUICK} {references}"));
    for (part, has_references) in [("bars", true), ("flood", false)] {
        let run: measure::Run = sandbox.read_json(&format!("{part}/run.json"));
        assert!(!run.cases.is_empty());
        let mut cases = run.cases.iter();
        assert!(cases.all(|case| case.is_reference == has_references));
        assert!(!sandbox.path(part).join("report.html").exists());
    }
}
