//! The journal of a tuning: kills, full disks, foreign files, other budgets.

use std::fs;
use std::process::Command;
use std::sync::OnceLock;

use super::{ON_TWO, TUNE, read_journal, set_up, tune};
use crate::sandbox::{assert_refused, split, stderr, wait_until};

const BUDGET: &str = "--scenes a,b --budget 24";

/// Returns the journal of an undisturbed tuning, which runs once for all tests.
fn whole() -> &'static str {
    static JOURNAL: OnceLock<String> = OnceLock::new();
    JOURNAL.get_or_init(|| {
        let sandbox = set_up();
        tune(&sandbox, "out", BUDGET);
        read_journal(&sandbox, "out")
    })
}

#[test]
fn a_killed_tuning_resumes_and_ends_with_the_same_bytes() {
    let sandbox = set_up();
    let words = format!("{TUNE} --out out {BUDGET}");
    let mut child = sandbox.command(&split(&words)).spawn().unwrap();
    let path = sandbox.path("out/journal.jsonl");
    wait_until(&mut child, || {
        fs::read_to_string(&path).is_ok_and(|text| text.lines().count() >= 4)
    });
    child.kill().unwrap();
    child.wait().unwrap();
    let left = read_journal(&sandbox, "out");
    assert!(left.lines().count() < 25, "it was killed on its way");
    // A power failure left this line half-written.
    fs::write(&path, format!("{left}{{\"trial\":7")).unwrap();
    tune(&sandbox, "out", BUDGET);
    assert_eq!(read_journal(&sandbox, "out"), whole());
}

#[test]
fn a_larger_budget_extends_a_smaller_one_and_another_seed_searches_differently() {
    let sandbox = set_up();
    let mut before = String::new();
    for (budget, lines) in [("4", 5), ("8", 9)] {
        tune(&sandbox, "out", &format!("{ON_TWO} --budget {budget}"));
        let journal = read_journal(&sandbox, "out");
        assert!(journal.starts_with(&before) && journal.lines().count() == lines);
        before = journal;
    }
    let other = format!("{TUNE} --out out {ON_TWO} --budget 8 --search-seed 2");
    let output = sandbox.shuttertruth(&split(&other));
    let parts = "journal.jsonl:1: it was begun with another seed: found 1, this command has 2 | \
        to go on with it, search with the seed 1 | another output folder";
    assert_refused(&output, 2, &parts);
    let said = stderr(&output);
    assert!(said.len() < 400, "a wall of numbers: {said}");
    assert_eq!(read_journal(&sandbox, "out"), before, "nothing is lost");
}

/// Limits the size of files, as a substitute for a full disk: either way, a write fails.
#[cfg(unix)]
#[test]
fn a_full_disk_loses_nothing() {
    let sandbox = set_up();
    tune(&sandbox, "out", &format!("{ON_TWO} --budget 1"));
    let begun = read_journal(&sandbox, "out");
    // Blocks of 512 bytes, with room for a few more trials.
    let blocks = (begun.len() + 2000).div_ceil(512).to_string();
    let program = env!("CARGO_BIN_EXE_shuttertruth");
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec {program} \"$@\"");
    let mut full = Command::new("sh");
    full.current_dir(sandbox.path(""))
        .args(["-c", &script, "sh"]);
    let words = format!("{TUNE} --out out {BUDGET}");
    let output = full.args(split(&words)).output().unwrap();
    let parts =
        "journal.jsonl: cannot be written | whole trials are safe | run the same command again";
    assert_refused(&output, 2, &parts);
    let left = read_journal(&sandbox, "out");
    assert!(left.starts_with(&begun) && left.len() > begun.len());
    tune(&sandbox, "out", BUDGET);
    assert_eq!(read_journal(&sandbox, "out"), whole());
}
