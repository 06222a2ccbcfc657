//! Jobs of a plan, run one by one, against one process.

use std::fs;
use std::path::{Path, PathBuf};

use super::{FILTERS, QUICK, execute, list, plan, two_parts};
use crate::sandbox::{Sandbox, assert_done, files_below, split, stdout};

/// Reads all files below a folder, but for some folders and for pages.
fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let files = files_below(folder).into_iter();
    let files = files.map(|path| (path.strip_prefix(folder).unwrap().to_owned(), path));
    let is_data = |name: &Path| {
        let text = name.to_string_lossy();
        !text.starts_with("parts/") && !text.contains(".shuttertruth") && text != "judgement.json"
    };
    files
        .filter(|(name, _)| is_data(name) && name.extension().is_none_or(|it| it != "html"))
        .map(|(name, path)| (name, fs::read(path).unwrap()))
        .collect()
}

/// Runs the jobs of a plan in one bench and the command itself in another; compares all files.
#[track_caller]
fn assert_jobs_equal_one_process(words: &[&str]) {
    let [shared, alone] = [(); 2].map(|()| Sandbox::two_scenes());
    let jobs = plan(&shared, words);
    for job in &jobs {
        execute(&shared, job);
    }
    alone.execute(&[&["run"], words].concat());
    let [shared, alone] = [shared, alone].map(|sandbox| contents(&sandbox.path("out")));
    let names = |files: &[(PathBuf, Vec<u8>)]| -> Vec<PathBuf> {
        files.iter().map(|(name, _)| name.clone()).collect()
    };
    assert_eq!(names(&shared), names(&alone));
    assert!(names(&alone).contains(&"run.json".into()));
    for ((name, shared), (_, alone)) in shared.iter().zip(&alone) {
        assert!(shared == alone, "{} differs", name.display());
    }
}

#[test]
fn jobs_of_a_plan_make_the_files_of_one_process() {
    let words = format!("{QUICK} {FILTERS} --intervals --set velocity_gather.samples=8 --out out");
    assert_jobs_equal_one_process(&split(&words));
}

#[test]
fn jobs_of_a_sequence_make_the_files_of_one_process() {
    let words = format!("{QUICK} --filter kino:default,identity --frames 3 --scenes plate,slow");
    assert_jobs_equal_one_process(&split(&words));
}

#[test]
fn jobs_of_a_calibration_leave_nothing_to_measure() {
    let words = format!("{QUICK} --filter identity --scenes plate --runs 2 --metrics flip_moving");
    let words = split(&words);
    let [shared, alone] = [(); 2].map(|()| Sandbox::new());
    let jobs = plan(&shared, &words);
    let (last, others) = jobs.split_last().unwrap();
    for job in others {
        execute(&shared, job);
    }
    let measured = |sandbox: &Sandbox| {
        let record = sandbox.path("out/seed_2/plate/identity_default/case.json");
        fs::metadata(record).unwrap().modified().unwrap()
    };
    let before = measured(&shared);
    let printed = execute(&shared, last);
    assert_eq!(measured(&shared), before, "a case was measured again");
    let words = [&["limits", "calibrate"], &words[..]].concat();
    assert_eq!(printed, alone.execute(&words));
}

#[test]
fn a_plan_is_a_table_or_one_line_per_job() {
    let sandbox = Sandbox::two_scenes();
    let words = format!("{QUICK} {FILTERS}");
    let words = split(&words);
    let jobs = plan(&sandbox, &words);
    let names: Vec<&str> = jobs
        .iter()
        .map(|job| job["job"].as_str().unwrap())
        .collect();
    let of_scene = |scene: &str| {
        ["truths", "references"]
            .map(|kind| format!("{kind}/{scene}"))
            .into_iter()
            .chain(
                ["velocity_gather", "kino", "identity"].map(|it| format!("filters/{scene}/{it}")),
            )
            .collect::<Vec<_>>()
    };
    let last = ["merge", "report"].map(str::to_owned).to_vec();
    assert_eq!(names, [of_scene("plate"), of_scene("slow"), last].concat());
    let seconds = |job: &str| {
        let job = jobs.iter().find(|own| own["job"] == job).unwrap();
        assert!(job["memory"].as_u64().unwrap() > 50 << 20, "{job}");
        job["cpu_seconds"].as_f64().unwrap()
    };
    // Three presets take longer than one, and eight references longer still.
    assert!(seconds("filters/plate/velocity_gather") > seconds("filters/plate/identity"));
    assert!(seconds("references/plate") > seconds("filters/plate/identity"));
    let table = sandbox.execute(&[&["truths", "plan"], &words[..]].concat());
    for name in names {
        assert!(table.contains(name), "{name} is missing from:\n{table}");
    }
    assert!(!sandbox.path("out").exists(), "a plan writes nothing");
}

#[test]
fn parts_made_by_hand_are_joined_without_a_plan() {
    let sandbox = two_parts();
    let output = sandbox.shuttertruth(&["truths", "merge", "plate", "slow", "--out", "both"]);
    assert_done(&output);
    assert_eq!(stdout(&output), "both/run.json (16 cases of 2 parts)\n");
    let words = [&["run"], &split(QUICK)[..], &["--filter", "identity"]].concat();
    sandbox.execute(&words);
    // The command is the one difference.
    let read = |out: &str| {
        let mut run: serde_json::Value = sandbox.read_json(&format!("{out}/run.json"));
        run["command"].take();
        run
    };
    assert_eq!(read("both"), read("out"));
    sandbox.execute(&["report", "both"]);
    // A part twice is no other run.
    let words = [
        "truths", "merge", "plate", "slow", "plate", "--out", "twice",
    ];
    sandbox.execute(&words);
    assert_eq!(read("twice"), read("both"));
}

#[test]
fn truths_of_another_folder_are_taken_if_their_inputs_are_the_same() {
    let sandbox = Sandbox::new();
    let render = "truths render --quiet --scenes plate --size 64x32 --samples-per-pixel 16 --ladders --out kept";
    sandbox.execute(&split(render));
    let with = |out: &str, more: &[&str]| {
        let words = ["run", "--filter", "identity", "--out", out];
        sandbox.execute(&[&words[..], &split(QUICK), more].concat());
    };
    let written = |path: &str| {
        fs::metadata(sandbox.path(path))
            .unwrap()
            .modified()
            .unwrap()
    };
    with("same", &["--truths", "kept"]);
    for name in ["frame.exr", "truth_trailing.exr", "ladder_trailing/n64.exr"] {
        let [kept, taken] = ["kept", "same"].map(|out| written(&format!("{out}/plate/{name}")));
        assert_eq!(kept, taken, "{name} was rendered again");
    }
    let truth =
        |out: &str| fs::read(sandbox.path(&format!("{out}/plate/truth_trailing.exr"))).unwrap();
    with("other", &["--truths", "kept", "--seed", "2"]);
    with("alone", &["--seed", "2"]);
    assert_ne!(
        truth("other"),
        truth("kept"),
        "a truth of another seed was taken"
    );
    assert_eq!(truth("other"), truth("alone"));
    // What is made anew in one folder leaves the other as it is.
    let before = truth("kept");
    with("same", &["--seed", "2"]);
    assert_eq!(truth("kept"), before);
}

#[test]
fn a_part_holds_its_references_or_its_filters_and_has_no_report() {
    let sandbox = Sandbox::new();
    for (part, has_references) in [("references", true), ("filters", false)] {
        let words = ["run", "--filter", "identity", "--part", part, "--out", part];
        sandbox.execute(&[&words[..], &split(QUICK)].concat());
        let run: suite::Run = sandbox.read_json(&format!("{part}/run.json"));
        assert!(!run.cases.is_empty());
        assert!(
            run.cases
                .iter()
                .all(|case| case.is_reference == has_references)
        );
        assert!(!sandbox.path(part).join("report.html").exists());
    }
}

#[test]
fn a_plan_of_a_user_s_own_files_names_them() {
    let sandbox = Sandbox::new();
    tests::filter_folder::copy_shipped_filter("velocity_gather", &sandbox.path("my_blur"));
    fs::create_dir(sandbox.path("kept")).unwrap();
    let words = format!("{QUICK} --scenes ./scenes/plate --filter my_blur:fine --truths kept");
    let jobs = plan(&sandbox, &split(&words));
    let job = |name: &str| jobs.iter().find(|job| job["job"] == name).unwrap();
    assert!(
        jobs.iter().all(|job| job["job"] != "truths/plate"),
        "they are kept"
    );
    let own = job("filters/plate/velocity_gather");
    assert!(list(own, "arguments").contains(&"./my_blur:fine".to_owned()));
    let inputs = list(own, "inputs");
    for file in ["./scenes/plate/scene.toml", "./my_blur/filter.toml"] {
        assert!(inputs.contains(&file.to_owned()), "{file}: {inputs:?}");
    }
    for job in &jobs {
        execute(&sandbox, job);
    }
}

#[test]
fn jobs_of_frame_rates_make_the_files_of_one_process() {
    let words = format!(
        "{QUICK} --filter identity --frame-rate 24,144 --shutter-time 1/48 --input rule=in_frames --scenes plate"
    );
    assert_jobs_equal_one_process(&split(&words));
}
