//! Files in `--out` that a check must not believe.

use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

use metrics::{Measured, Metric};
use serde::{Deserialize, Serialize};
use suite::Case;

use crate::bench::{Bench, IDENTITY, assert_refused, quick_command, stdout};

const RECORD: &str = "out/plate/identity_default/case.json";

/// Layout of a record in a case's folder.
#[derive(Serialize, Deserialize)]
struct Record {
    inputs: String,
    files: BTreeMap<String, String>,
    made: Case,
}

/// Makes a bench whose scene has a bound that the identity breaks.
fn set_up() -> Bench {
    let bench = Bench::new();
    bench.write_bound(0.2);
    bench
}

/// Writes a good score into the record, as anybody could.
fn forge(bench: &Bench) {
    let text = fs::read(bench.path(RECORD)).unwrap();
    let mut record: Record = serde_json::from_slice(&text).unwrap();
    record.made.scores.moving.flip = Measured::score(0.001, 0.001);
    let interval = (record.made.intervals.get_mut(&Metric::FLIP)).expect("it is bounded");
    (interval.low, interval.high) = (0.0, 0.002);
    fs::write(bench.path(RECORD), serde_json::to_vec(&record).unwrap()).unwrap();
}

fn git(bench: &Bench, words: &[&str]) {
    let mut git = Command::new("git");
    git.current_dir(bench.path("")).args(words);
    let output = git.output().unwrap();
    assert!(output.status.success(), "git {words:?}: {output:?}");
}

#[test]
fn a_check_without_cache_ignores_a_forged_record() {
    let bench = set_up();
    let first = bench.check(&IDENTITY);
    assert_eq!(first.status.code(), Some(1));
    forge(&bench);
    let trusting = bench.check(&IDENTITY);
    assert_eq!(
        trusting.status.code(),
        Some(0),
        "a folder of one's own is trusted"
    );
    let no_cache = [&IDENTITY[..], &["--no-cache"]].concat();
    let anew = bench.check(&no_cache);
    assert_eq!(anew.status.code(), Some(1));
    assert_eq!(stdout(&anew), stdout(&first));
    // The new measurement is kept.
    assert_eq!(stdout(&bench.check(&IDENTITY)), stdout(&first));
}

#[test]
fn a_check_refuses_a_folder_tracked_by_git() {
    let bench = set_up();
    let first = bench.check(&IDENTITY);
    git(&bench, &["init", "-q"]);
    // The folder lies below a work tree without being part of it.
    assert_eq!(stdout(&bench.check(&IDENTITY)), stdout(&first));
    forge(&bench);
    git(&bench, &["add", "-f", RECORD]);
    let parts = [RECORD, "is tracked by git", "--no-cache"];
    assert_refused(&bench.check(&IDENTITY), 2, &parts);
    let finished = bench.shuttertruth(&["check", "out/run.json"]);
    let parts = [RECORD, "is tracked by git", "measure it now"];
    assert_refused(&finished, 2, &parts);

    git(&bench, &["rm", "-q", "--cached", RECORD]);
    fs::create_dir(bench.path("kept")).unwrap();
    fs::write(bench.path("kept/frame.exr"), "a change brings it").unwrap();
    git(&bench, &["add", "-f", "kept/frame.exr"]);
    let with_truths = [&IDENTITY[..], &["--truths", "kept"]].concat();
    let parts = ["kept/frame.exr", "is tracked by git", "--truths"];
    assert_refused(&bench.check(&with_truths), 2, &parts);

    git(&bench, &["add", "-f", RECORD]);
    let words = [&quick_command("check", "64")[..], &IDENTITY].concat();
    let mut without_git = bench.command(&words);
    without_git.env("PATH", "/nowhere").env_remove("CI");
    let output = without_git.output().unwrap();
    assert_refused(&output, 2, &["cannot tell", "git: ", "--no-cache"]);
    // Git cannot track a file that does not exist.
    fs::remove_dir_all(bench.path("out")).unwrap();
    let output = without_git.output().unwrap();
    assert_eq!(output.status.code(), Some(1));
}

/// A repository's settings, such as `core.fsmonitor`, can make git start programs.
#[cfg(unix)]
#[test]
fn a_nested_repository_starts_no_program() {
    let bench = set_up();
    git(&bench, &["init", "-q"]);
    git(&bench, &["init", "-q", "--bare", "out"]);
    let hook = format!("touch {}", bench.path("ran").display());
    for (name, value) in [
        ("core.bare", "false"),
        ("core.worktree", "."),
        ("core.fsmonitor", &hook),
    ] {
        git(&bench, &["config", "--file", "out/config", name, value]);
    }
    assert_refused(&bench.check(&IDENTITY), 2, &["cannot tell whether"]);
    assert!(!bench.path("ran").exists(), "a program ran");
}
