//! Jobs of a plan, run one by one, against one process.

use std::fs;

use tests::text::assert_contains;

use super::{FILTERS, QUICK, execute, list, parts, plan};
use crate::sandbox::{Files, Sandbox, assert_same_files, read_below};

/// Reads all files of a run except the jobs' own, its judgement, and pages.
fn contents(sandbox: &Sandbox) -> Files {
    let mut files = read_below(&sandbox.path("out"));
    files.retain(|(name, _)| {
        let text = name.to_string_lossy();
        let is_own = text.starts_with("parts/") || text.contains(".shuttertruth");
        !is_own && text != "judgement.json" && !text.ends_with(".html")
    });
    files
}

/// Runs the jobs of a plan in one sandbox and the command itself in another; compares all files.
#[track_caller]
fn assert_jobs_equal_one_process(words: &str) {
    let words = format!("{QUICK} --filter {words}");
    let [shared, alone] = [(); 2].map(|()| Sandbox::two_scenes());
    for job in &plan(&shared, &words) {
        execute(&shared, job);
    }
    alone.done(&format!("run {words}"));
    let whole = contents(&alone);
    assert!(alone.path("out/run.json").is_file());
    assert_same_files(&contents(&shared), &whole);
}

#[test]
fn jobs_of_a_plan_make_the_files_of_one_process() {
    let more = "--intervals --set velocity_gather.samples=8 --out out";
    assert_jobs_equal_one_process(&format!("{FILTERS} {more}"));
}

#[test]
fn jobs_of_a_sequence_make_the_files_of_one_process() {
    assert_jobs_equal_one_process("kino:default,identity --frames 2 --scenes plate");
}

#[test]
fn jobs_of_frame_rates_make_the_files_of_one_process() {
    let rates = "--frame-rate 24 --shutter-time 1/48 --input rule=in_frames";
    assert_jobs_equal_one_process(&format!("identity {rates} --scenes plate"));
}

#[test]
fn jobs_of_a_calibration_leave_nothing_to_measure() {
    let words = format!("{QUICK} --filter identity --scenes plate --runs 2 --metrics flip_moving");
    let [shared, alone] = [(); 2].map(|()| Sandbox::new());
    let jobs = plan(&shared, &words);
    let (last, others) = jobs.split_last().unwrap();
    for job in others {
        execute(&shared, job);
    }
    let written = || shared.written("out/seed_2/plate/identity_default/case.json");
    let before = written();
    let printed = execute(&shared, last);
    assert_eq!(written(), before, "a case was measured again");
    assert_eq!(printed, alone.done(&format!("limits calibrate {words}")));
}

#[test]
fn a_plan_is_a_table_or_one_line_per_job() {
    let sandbox = Sandbox::two_scenes();
    let words = format!("{QUICK} --filter {FILTERS}");
    let jobs = plan(&sandbox, &words);
    let names: Vec<&str> = (jobs.iter())
        .map(|job| job["job"].as_str().unwrap())
        .collect();
    let due = "truths/SCENE references/SCENE filters/SCENE/velocity_gather filters/SCENE/kino";
    let due = ["plate", "slow"].map(|scene| due.replace("SCENE", scene));
    let due = format!("{} merge report", due.join(" "));
    assert_eq!(names.join(" "), due);
    let seconds = |name: &str| {
        let mut own = jobs.iter().zip(&names).filter(|(_, own)| **own == name);
        let job = own.next().unwrap().0;
        assert!(job["memory"].as_u64().unwrap() > 50 << 20, "{job}");
        job["cpu_seconds"].as_f64().unwrap()
    };
    // Two presets take longer than one, and eight references longer still.
    let one = seconds("filters/plate/kino");
    assert!(seconds("filters/plate/velocity_gather") > one);
    assert!(seconds("references/plate") > one);
    assert_contains(&sandbox.done(&format!("truths plan {words}")), &names);
    assert!(!sandbox.path("out").exists(), "a plan writes nothing");
}

#[test]
fn parts_made_by_hand_are_joined_without_a_plan() {
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
        let run: suite::Run = sandbox.read_json(&format!("{part}/run.json"));
        assert!(!run.cases.is_empty());
        let mut cases = run.cases.iter();
        assert!(cases.all(|case| case.is_reference == has_references));
        assert!(!sandbox.path(part).join("report.html").exists());
    }
}

#[test]
fn a_plan_of_a_user_s_own_files_names_them() {
    let sandbox = Sandbox::new();
    tests::filter_folder::copy_shipped_filter("velocity_gather", &sandbox.path("my_blur"));
    fs::create_dir(sandbox.path("kept")).unwrap();
    let words = "--scenes ./scenes/plate --filter my_blur:fine --truths kept";
    let jobs = plan(&sandbox, &format!("{QUICK} {words}"));
    let find = |name: &str| jobs.iter().find(|job| job["job"] == name);
    assert!(find("truths/plate").is_none(), "they are kept");
    let own = find("filters/plate/velocity_gather").unwrap();
    assert!(list(own, "arguments").contains(&"./my_blur:fine".to_owned()));
    let inputs = list(own, "inputs");
    for file in ["./scenes/plate/scene.toml", "./my_blur/filter.toml"] {
        assert!(inputs.contains(&file.to_owned()), "{file}: {inputs:?}");
    }
    for job in &jobs {
        execute(&sandbox, job);
    }
}
