//! Runs that `merge` must not join.

use std::fs;

use super::{QUICK, two_parts};
use crate::sandbox::{Sandbox, assert_refused, split};

#[track_caller]
fn refused(sandbox: &Sandbox, parts: &[&str], found: &[&str]) {
    let output = sandbox.shuttertruth(&[&["truths", "merge"], parts, &["--out", "whole"]].concat());
    assert_refused(&output, 2, found);
    assert!(
        !sandbox.path("whole").exists(),
        "{parts:?} left something behind"
    );
}

/// Changes the text of a run.json.
fn change(sandbox: &Sandbox, part: &str, from: &str, to: &str) {
    let path = sandbox.path(part).join("run.json");
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains(from), "{text}");
    fs::write(path, text.replacen(from, to, 1)).unwrap();
}

/// Measures once more, into the folder `other`.
fn measure_other(sandbox: &Sandbox, more: &[&str]) {
    let words = ["run", "--out", "other"];
    sandbox.execute(&[&words[..], &split(QUICK), more].concat());
}

#[test]
fn runs_of_other_settings_are_refused() {
    let sandbox = two_parts();
    for (more, found) in [
        ("--seed 2", "has the seed 1, other/run.json has 2"),
        (
            "--velocity previous_frame",
            "has the velocity instantaneous",
        ),
        ("--frames 2", "has the number of frames 1 at 60 per second"),
    ] {
        measure_other(
            &sandbox,
            &split(&format!(
                "--filter identity --scenes slow --no-cache {more}"
            )),
        );
        refused(&sandbox, &["plate", "other"], &["plate/run.json", found]);
    }
    measure_other(
        &sandbox,
        &split("--filter kino:default --scenes slow --no-cache"),
    );
    let found = [
        "common shutter trailing",
        "has centred",
        "the same common shutter",
    ];
    refused(&sandbox, &["plate", "other"], &found);
}

#[test]
fn a_run_on_another_adapter_is_refused() {
    let sandbox = two_parts();
    change(&sandbox, "slow", "\"driver\": \"", "\"driver\": \"other ");
    let found = [
        "plate/run.json has the adapter and driver",
        "slow/run.json has",
        "(other ",
        "the same adapter and driver",
    ];
    refused(&sandbox, &["plate", "slow"], &found);
}

#[test]
fn cases_against_other_truths_are_refused() {
    let sandbox = two_parts();
    let words = "--filter jump_flood:paper --scenes plate --exposure 0.25";
    measure_other(&sandbox, &split(words));
    refused(
        &sandbox,
        &["plate", "other"],
        &["hold plate / identity (trailing) with other numbers"],
    );
    let filters = [&split(words)[..], &["--part", "filters", "--no-cache"]].concat();
    measure_other(&sandbox, &filters);
    let found = ["plate/plate/frame.exr and other/plate/frame.exr differ"];
    refused(&sandbox, &["plate", "other"], &found);
    // The same exposure, and another truth: that of another tracer.
    let words = "--filter jump_flood:paper --scenes plate --part filters --no-cache";
    measure_other(&sandbox, &split(words));
    change(
        &sandbox,
        "other",
        "\"truth_hash\": \"",
        "\"truth_hash\": \"0",
    );
    refused(
        &sandbox,
        &["plate", "other"],
        &[
            "other/run.json: the truth of plate/jump_flood_paper has the hash 0",
            "plate/plate/truth_trailing.exr has",
        ],
    );
}

#[test]
fn one_case_with_two_scores_is_refused() {
    let sandbox = two_parts();
    fs::create_dir(sandbox.path("copy")).unwrap();
    fs::copy(
        sandbox.path("plate/run.json"),
        sandbox.path("copy/run.json"),
    )
    .unwrap();
    change(&sandbox, "copy", "\"value\": 0.", "\"value\": 1.");
    refused(
        &sandbox,
        &["plate", "copy"],
        &[
            "plate/run.json and copy/run.json hold plate / ",
            "with other numbers",
        ],
    );
}

#[test]
fn one_picture_with_two_contents_is_refused() {
    let sandbox = two_parts();
    let words = "--filter jump_flood:paper --scenes plate --part filters";
    measure_other(&sandbox, &split(words));
    fs::write(sandbox.path("other/plate/frame.png"), "another frame").unwrap();
    refused(
        &sandbox,
        &["plate", "other"],
        &["plate/plate/frame.png and other/plate/frame.png differ"],
    );
}

#[test]
fn missing_cases_are_named() {
    let sandbox = two_parts();
    measure_other(&sandbox, &split("--filter jump_flood:paper --scenes plate"));
    refused(
        &sandbox,
        &["plate", "slow", "other"],
        &["no part holds slow / jump_flood:paper (trailing shutter)"],
    );
    let part = "--filter identity --scenes plate --part filters --no-cache";
    measure_other(&sandbox, &split(part));
    refused(
        &sandbox,
        &["other"],
        &[
            "references of the trailing shutter",
            "the part with the references",
        ],
    );
}

#[test]
fn truths_are_not_looked_for_in_vain() {
    let sandbox = Sandbox::new();
    let run = |more: &[&str]| {
        let words = [&["run", "--filter", "identity"], &split(QUICK)[..], more].concat();
        sandbox.shuttertruth(&words)
    };
    let found = [
        "--truths nowhere: there is no such folder",
        "truths render --ladders",
    ];
    assert_refused(&run(&["--truths", "nowhere"]), 2, &found);
    let output = run(&["--truths", "scenes", "--no-cache"]);
    assert_refused(&output, 2, &["--truths", "--no-cache"]);
    assert!(!sandbox.path("out").exists());
}

#[test]
fn what_holds_no_run_is_refused() {
    let sandbox = two_parts();
    fs::create_dir(sandbox.path("empty")).unwrap();
    refused(
        &sandbox,
        &["plate", "empty"],
        &["empty holds no replicates", "or finished runs alone"],
    );
    fs::write(sandbox.path("empty/run.json"), "{").unwrap();
    refused(
        &sandbox,
        &["plate", "empty"],
        &["empty/run.json", "no run of this program"],
    );
    refused(&sandbox, &["plate", "nowhere"], &["nowhere"]);
}

#[cfg(unix)]
#[test]
fn nothing_behind_a_link_is_taken() {
    let sandbox = two_parts();
    fs::write(sandbox.path("secret"), "mine").unwrap();
    let link = |link: &str, target: &str| {
        let path = sandbox.path(link);
        match path.is_dir() {
            true => fs::remove_dir_all(&path).unwrap(),
            false => fs::remove_file(&path).unwrap(),
        }
        std::os::unix::fs::symlink(sandbox.path(target), path).unwrap();
    };
    link("slow/slow/ladder_trailing", "plate");
    sandbox.execute(&["truths", "merge", "plate", "slow", "--out", "without"]);
    assert!(!sandbox.path("without/slow/ladder_trailing").exists());
    link("slow/slow/frame.png", "secret");
    let found = ["no part holds slow/frame.png, or it is a link"];
    refused(&sandbox, &["plate", "slow"], &found);
    assert!(!sandbox.path("whole").exists());
}

#[test]
fn parts_without_all_of_their_pictures_are_refused() {
    let sandbox = two_parts();
    for file in [
        "slow/identity_default/output.exr",
        "slow/identity_trailing/flip.png",
        "slow/truth_trailing.exr",
        "slow/velocity.png",
    ] {
        let path = sandbox.path("slow").join(file);
        let whole = fs::read(&path).unwrap();
        fs::remove_file(&path).unwrap();
        let found = [
            &*format!("slow/run.json: no part holds {file}"),
            "measure that case again",
        ];
        refused(&sandbox, &["plate", "slow"], &found);
        assert!(!sandbox.path("whole").exists());
        fs::write(&path, whole).unwrap();
    }
    sandbox.execute(&["truths", "merge", "plate", "slow", "--out", "whole"]);
}
