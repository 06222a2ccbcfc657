//! Runs of some of the cases, joined.

use std::fs;

use crate::sandbox::Sandbox;

/// Options that measure very quickly.
pub const QUICK: &str = "--quiet --size 64x32 --samples-per-pixel 16 --jitter-frames 2";

/// Measures two scenes in one folder each, with one filter and the references; and another filter
/// without them.
pub fn parts() -> Sandbox {
    Sandbox::once(|sandbox| {
        sandbox.add_slow_scene();
        for line in [
            "--filter identity --scenes plate --out plate",
            "--filter identity --scenes slow --out slow",
            "--filter jump_flood:paper --scenes plate --part filters --out flood",
        ] {
            sandbox.done(&format!("run {QUICK} {line}"));
        }
    })
}

#[track_caller]
fn refuse<T: AsRef<str>>(sandbox: &Sandbox, parts: &str, message: &[T]) {
    sandbox.refuse(&format!("truths merge {parts} --out whole"), message);
    assert!(!sandbox.path("whole").exists(), "{parts} wrote files");
}

/// Measures once more, into the folder `other`.
fn measure_other(sandbox: &Sandbox, more: &str) {
    sandbox.done(&format!("run --out other --no-cache {QUICK} {more}"));
}

/// More words of `run`, and parts of the message.
const OTHER_RUNS: [(&str, &[&str]); 4] = [
    (
        "identity --seed 2",
        &["plate/run.json", "has the seed 1, other/run.json has 2"],
    ),
    (
        "identity --velocity previous_frame",
        &["plate/run.json", "has the velocity instantaneous"],
    ),
    (
        "identity --frames 2",
        &[
            "plate/run.json",
            "has the number of frames 1 at 60 per second",
        ],
    ),
    (
        "kino:default",
        &[
            "plate/run.json",
            "common shutter trailing",
            "has centred",
            "the same common shutter",
        ],
    ),
];

/// A setting in run.json, another value, and the row of [`OTHER_RUNS`] with its message. A run of
/// one frame does not name their number.
const OTHER_SETTINGS: [(&str, &str, usize); 4] = [
    ("\"seed\": 1", "\"seed\": 2", 0),
    ("\"instantaneous\"", "\"previous_frame\"", 1),
    (
        "\"cases\": [",
        "\"frames\": {\"count\": 2, \"per_second\": 60.0}, \"cases\": [",
        2,
    ),
    (
        "\"common_alignment\": \"trailing\"",
        "\"common_alignment\": \"centred\"",
        3,
    ),
];

#[test]
#[ignore = "prove: runs of other settings, measured"]
fn measured_runs_of_other_settings_are_refused() {
    let sandbox = parts();
    for (more, message) in OTHER_RUNS {
        measure_other(&sandbox, &format!("--scenes slow --filter {more}"));
        refuse(&sandbox, "plate other", message);
    }
}

#[test]
fn runs_of_other_settings_are_refused() {
    let sandbox = parts();
    for (setting, other, row) in OTHER_SETTINGS {
        sandbox.put("other/run.json", sandbox.text("slow/run.json"));
        sandbox.edit("other/run.json", setting, other);
        refuse(&sandbox, "plate other", OTHER_RUNS[row].1);
    }
    sandbox.edit("slow/run.json", "\"driver\": \"", "\"driver\": \"other ");
    let message = [
        "plate/run.json has the adapter and driver",
        "slow/run.json has",
        "(other ",
        "the same adapter and driver",
    ];
    refuse(&sandbox, "plate slow", &message);
}

#[test]
fn cases_against_other_truths_are_refused() {
    let sandbox = parts();
    let words = "--filter jump_flood:paper --scenes plate --exposure 0.25";
    measure_other(&sandbox, words);
    let message = "hold plate / identity (trailing) with other numbers";
    refuse(&sandbox, "plate other", &[message]);
    measure_other(&sandbox, &format!("{words} --part filters"));
    let message = "plate/plate/frame.exr and other/plate/frame.exr differ";
    refuse(&sandbox, "plate other", &[message]);
    // The exposure is the same, but the truth is of another tracer.
    let hash = "\"truth_hash\": \"";
    sandbox.edit("flood/run.json", hash, &format!("{hash}0"));
    let message = [
        "flood/run.json: the truth of plate/jump_flood_paper has the hash 0",
        "plate/plate/truth_trailing.exr has",
    ];
    refuse(&sandbox, "plate flood", &message);
}

#[test]
fn one_case_or_picture_with_two_contents_is_refused() {
    let sandbox = parts();
    sandbox.put("copy/run.json", sandbox.text("plate/run.json"));
    sandbox.edit("copy/run.json", "\"value\": 0.", "\"value\": 1.");
    let message = [
        "plate/run.json and copy/run.json hold plate / ",
        "with other numbers",
    ];
    refuse(&sandbox, "plate copy", &message);
    sandbox.put("flood/plate/frame.png", "another frame");
    let message = "plate/plate/frame.png and flood/plate/frame.png differ";
    refuse(&sandbox, "plate flood", &[message]);
}

#[test]
fn missing_cases_are_named() {
    let sandbox = parts();
    let message = "no part holds slow / jump_flood:paper (trailing shutter)";
    refuse(&sandbox, "plate slow flood", &[message]);
    let message = [
        "references of the trailing shutter",
        "the part with the references",
    ];
    refuse(&sandbox, "flood", &message);
}

/// Folders that hold no run, and parts of the message.
const NO_RUNS: [(&str, &[&str]); 3] = [
    (
        "empty",
        &["empty holds no replicates", "or finished runs alone"],
    ),
    ("damaged", &["damaged/run.json", "no run of this program"]),
    ("nowhere", &["nowhere"]),
];

#[test]
fn what_holds_no_run_is_refused() {
    let sandbox = parts();
    fs::create_dir(sandbox.path("empty")).unwrap();
    sandbox.put("damaged/run.json", "{");
    sandbox.refuse_each("truths merge --out whole plate", &NO_RUNS);
    assert!(!sandbox.path("whole").exists(), "nothing is written");
}

#[cfg(unix)]
#[test]
fn nothing_behind_a_link_is_taken() {
    let sandbox = parts();
    sandbox.put("secret", "mine");
    let link = |link: &str, target: &str| {
        let path = sandbox.path(link);
        if path.is_dir() {
            fs::remove_dir_all(&path).unwrap()
        } else {
            fs::remove_file(&path).unwrap()
        }
        std::os::unix::fs::symlink(sandbox.path(target), path).unwrap();
    };
    link("slow/slow/ladder_trailing", "plate");
    sandbox.done("truths merge plate slow --out without");
    assert!(!sandbox.path("without/slow/ladder_trailing").exists());
    link("slow/slow/frame.png", "secret");
    let message = "no part holds slow/frame.png, or it is a link";
    refuse(&sandbox, "plate slow", &[message]);
}

#[test]
fn parts_without_all_of_their_pictures_are_refused() {
    let sandbox = parts();
    let files =
        "identity_default/output.exr identity_trailing/flip.png truth_trailing.exr velocity.png";
    for file in files.split(' ').map(|name| format!("slow/{name}")) {
        let path = sandbox.path("slow").join(&file);
        let whole = fs::read(&path).unwrap();
        fs::remove_file(&path).unwrap();
        let message = format!("slow/run.json: no part holds {file}");
        refuse(
            &sandbox,
            "plate slow",
            &[&message, "measure that case again"],
        );
        fs::write(&path, whole).unwrap();
    }
    sandbox.done("truths merge plate slow --out whole");
}
