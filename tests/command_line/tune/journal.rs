//! The journal of a tuning: kills, full disks, foreign files, other budgets.

use std::fs;
use std::process::Command;
use std::time::{Duration, Instant};

use super::{read_journal, set_up, tuning_words};
use crate::sandbox::assert_refused;

#[test]
fn a_killed_tuning_resumes_and_ends_with_the_same_bytes() {
    let sandbox = set_up();
    sandbox.execute(&tuning_words("whole", "30", &[]));
    let mut child = sandbox
        .command(&tuning_words("killed", "30", &[]))
        .spawn()
        .unwrap();
    let path = sandbox.path("killed/journal.jsonl");
    let began = Instant::now();
    while fs::read_to_string(&path).map_or(0, |text| text.lines().count()) < 8 {
        // A generous limit: it takes a second or two.
        assert!(
            began.elapsed() < Duration::from_secs(120),
            "no trial after two minutes"
        );
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let left = read_journal(&sandbox, "killed");
    assert!(left.lines().count() < 31, "it was killed on its way");
    // A power failure left this line half written.
    fs::write(&path, format!("{left}{{\"trial\":7")).unwrap();
    sandbox.execute(&tuning_words("killed", "30", &[]));
    assert_eq!(
        read_journal(&sandbox, "killed"),
        read_journal(&sandbox, "whole")
    );
}

#[test]
fn a_foreign_journal_is_left_unchanged() {
    let sandbox = set_up();
    let path = sandbox.path("out/journal.jsonl");
    fs::create_dir_all(sandbox.path("out")).unwrap();
    for foreign in [
        "my notes, without an end of line",
        "{\"format\":1}\nand half a line",
        "first line\nsecond line\n",
    ] {
        fs::write(&path, foreign).unwrap();
        let refused = sandbox.shuttertruth(&tuning_words("out", "4", &[]));
        assert_refused(&refused, 2, &["journal.jsonl:1:", "another output folder"]);
        assert_eq!(fs::read_to_string(&path).unwrap(), foreign);
    }
}

#[test]
fn a_larger_budget_extends_a_smaller_one_and_another_seed_searches_differently() {
    let sandbox = set_up();
    sandbox.execute(&tuning_words("out", "12", &[]));
    let first = read_journal(&sandbox, "out");
    sandbox.execute(&tuning_words("out", "16", &[]));
    let second = read_journal(&sandbox, "out");
    assert!(second.starts_with(&first) && second.lines().count() == 17);
    let other = tuning_words("out", "16", &["--search-seed", "2"]);
    let output = sandbox.shuttertruth(&other);
    let parts = [
        "journal.jsonl:1: it was begun with another seed: found 1, this command has 2",
        "to go on with it, search with the seed 1",
        "another output folder",
    ];
    assert_refused(&output, 2, &parts);
    let said = crate::sandbox::stderr(&output);
    assert!(said.len() < 400, "a wall of numbers: {said}");
    assert_eq!(read_journal(&sandbox, "out"), second, "nothing is lost");
}

/// Limits the size of files, which stands in for a full disk: either way, a write fails.
#[cfg(unix)]
#[test]
fn a_full_disk_loses_nothing() {
    let sandbox = set_up();
    sandbox.execute(&tuning_words("out", "1", &[]));
    let begun = read_journal(&sandbox, "out");
    // Blocks of 512 bytes, with room for a few more trials.
    let blocks = (begun.len() + 2000).div_ceil(512).to_string();
    let program = env!("CARGO_BIN_EXE_shuttertruth");
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec {program} \"$@\"");
    let mut full = Command::new("sh");
    full.current_dir(sandbox.path(""))
        .args(["-c", &script, "sh"]);
    let output = full.args(tuning_words("out", "20", &[])).output().unwrap();
    assert_refused(
        &output,
        2,
        &[
            "journal.jsonl: cannot be written",
            "whole trials are safe",
            "run the same command again",
        ],
    );
    let left = read_journal(&sandbox, "out");
    assert!(left.starts_with(&begun) && left.len() > begun.len());
    sandbox.execute(&tuning_words("out", "20", &[]));
    sandbox.execute(&tuning_words("whole", "20", &[]));
    assert_eq!(
        read_journal(&sandbox, "out"),
        read_journal(&sandbox, "whole")
    );
}
