//! Runs that `merge` must not join.

use std::fs;

use super::{QUICK, two_parts};
use crate::bench::{Bench, assert_refused, split};

#[track_caller]
fn refused(bench: &Bench, parts: &[&str], found: &[&str]) {
    let output = bench.shuttertruth(&[&["truths", "merge"], parts, &["--out", "whole"]].concat());
    assert_refused(&output, 2, found);
    assert!(
        !bench.path("whole").exists(),
        "{parts:?} left something behind"
    );
}

/// Changes the text of a run.json.
fn change(bench: &Bench, part: &str, from: &str, to: &str) {
    let path = bench.path(part).join("run.json");
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains(from), "{text}");
    fs::write(path, text.replacen(from, to, 1)).unwrap();
}

/// Measures once more, into the folder `other`.
fn measure_other(bench: &Bench, more: &[&str]) {
    let words = ["run", "--out", "other"];
    bench.execute(&[&words[..], &split(QUICK), more].concat());
}

#[test]
fn runs_of_other_settings_are_refused() {
    let bench = two_parts();
    for (more, found) in [
        ("--seed 2", "has the seed 1, other/run.json has 2"),
        (
            "--velocity previous_frame",
            "has the velocity instantaneous",
        ),
        ("--frames 2", "has the number of frames 1 at 60 per second"),
    ] {
        measure_other(
            &bench,
            &split(&format!(
                "--filter identity --scenes slow --no-cache {more}"
            )),
        );
        refused(&bench, &["plate", "other"], &["plate/run.json", found]);
    }
    measure_other(
        &bench,
        &split("--filter kino:default --scenes slow --no-cache"),
    );
    let found = [
        "common shutter trailing",
        "has centred",
        "the same common shutter",
    ];
    refused(&bench, &["plate", "other"], &found);
}

#[test]
fn a_run_on_another_adapter_is_refused() {
    let bench = two_parts();
    change(&bench, "slow", "\"driver\": \"", "\"driver\": \"other ");
    let found = [
        "plate/run.json has the adapter and driver",
        "slow/run.json has",
        "(other ",
        "the same adapter and driver",
    ];
    refused(&bench, &["plate", "slow"], &found);
}

#[test]
fn cases_against_other_truths_are_refused() {
    let bench = two_parts();
    let words = "--filter jump_flood:paper --scenes plate --exposure 0.25";
    measure_other(&bench, &split(words));
    refused(
        &bench,
        &["plate", "other"],
        &["hold plate / identity (trailing) with other numbers"],
    );
    let filters = [&split(words)[..], &["--part", "filters", "--no-cache"]].concat();
    measure_other(&bench, &filters);
    let found = ["plate/plate/frame.exr and other/plate/frame.exr differ"];
    refused(&bench, &["plate", "other"], &found);
    // The same exposure, and another truth: that of another tracer.
    let words = "--filter jump_flood:paper --scenes plate --part filters --no-cache";
    measure_other(&bench, &split(words));
    change(&bench, "other", "\"truth_hash\": \"", "\"truth_hash\": \"0");
    refused(
        &bench,
        &["plate", "other"],
        &[
            "other/run.json: the truth of plate/jump_flood_paper has the hash 0",
            "plate/plate/truth_trailing.exr has",
        ],
    );
}

#[test]
fn one_case_with_two_scores_is_refused() {
    let bench = two_parts();
    fs::create_dir(bench.path("copy")).unwrap();
    fs::copy(bench.path("plate/run.json"), bench.path("copy/run.json")).unwrap();
    change(&bench, "copy", "\"value\": 0.", "\"value\": 1.");
    refused(
        &bench,
        &["plate", "copy"],
        &[
            "plate/run.json and copy/run.json hold plate / ",
            "with other numbers",
        ],
    );
}

#[test]
fn one_picture_with_two_contents_is_refused() {
    let bench = two_parts();
    let words = "--filter jump_flood:paper --scenes plate --part filters";
    measure_other(&bench, &split(words));
    fs::write(bench.path("other/plate/frame.png"), "another frame").unwrap();
    refused(
        &bench,
        &["plate", "other"],
        &["plate/plate/frame.png and other/plate/frame.png differ"],
    );
}

#[test]
fn missing_cases_are_named() {
    let bench = two_parts();
    measure_other(&bench, &split("--filter jump_flood:paper --scenes plate"));
    refused(
        &bench,
        &["plate", "slow", "other"],
        &["no part holds slow / jump_flood:paper (trailing shutter)"],
    );
    let part = "--filter identity --scenes plate --part filters --no-cache";
    measure_other(&bench, &split(part));
    refused(
        &bench,
        &["other"],
        &[
            "references of the trailing shutter",
            "the part with the references",
        ],
    );
}

#[test]
fn truths_are_not_looked_for_in_vain() {
    let bench = Bench::new();
    let run = |more: &[&str]| {
        let words = [&["run", "--filter", "identity"], &split(QUICK)[..], more].concat();
        bench.shuttertruth(&words)
    };
    let found = [
        "--truths nowhere: there is no such folder",
        "truths render --ladders",
    ];
    assert_refused(&run(&["--truths", "nowhere"]), 2, &found);
    let output = run(&["--truths", "scenes", "--no-cache"]);
    assert_refused(&output, 2, &["--truths", "--no-cache"]);
    assert!(!bench.path("out").exists());
}

#[test]
fn what_holds_no_run_is_refused() {
    let bench = two_parts();
    fs::create_dir(bench.path("empty")).unwrap();
    refused(
        &bench,
        &["plate", "empty"],
        &["empty holds no replicates", "or finished runs alone"],
    );
    fs::write(bench.path("empty/run.json"), "{").unwrap();
    refused(
        &bench,
        &["plate", "empty"],
        &["empty/run.json", "no run of this program"],
    );
    refused(&bench, &["plate", "nowhere"], &["nowhere"]);
}

#[cfg(unix)]
#[test]
fn nothing_behind_a_link_is_taken() {
    let bench = two_parts();
    fs::write(bench.path("secret"), "mine").unwrap();
    let link = |link: &str, target: &str| {
        let path = bench.path(link);
        match path.is_dir() {
            true => fs::remove_dir_all(&path).unwrap(),
            false => fs::remove_file(&path).unwrap(),
        }
        std::os::unix::fs::symlink(bench.path(target), path).unwrap();
    };
    link("slow/slow/ladder_trailing", "plate");
    bench.execute(&["truths", "merge", "plate", "slow", "--out", "without"]);
    assert!(!bench.path("without/slow/ladder_trailing").exists());
    link("slow/slow/frame.png", "secret");
    let found = ["no part holds slow/frame.png, or it is a link"];
    refused(&bench, &["plate", "slow"], &found);
    assert!(!bench.path("whole").exists());
}

#[test]
fn parts_without_all_of_their_pictures_are_refused() {
    let bench = two_parts();
    for file in [
        "slow/identity_default/output.exr",
        "slow/identity_trailing/flip.png",
        "slow/truth_trailing.exr",
        "slow/velocity.png",
    ] {
        let path = bench.path("slow").join(file);
        let whole = fs::read(&path).unwrap();
        fs::remove_file(&path).unwrap();
        let found = [
            &*format!("slow/run.json: no part holds {file}"),
            "measure that case again",
        ];
        refused(&bench, &["plate", "slow"], &found);
        assert!(!bench.path("whole").exists());
        fs::write(&path, whole).unwrap();
    }
    bench.execute(&["truths", "merge", "plate", "slow", "--out", "whole"]);
}
