//! Edited journals of `tune`.

use std::fs;

use serde_json::Value;

use crate::sandbox::{Sandbox, make_fifo, rows};

const TUNE: &str = "tune search --quiet --filter jump_flood --vary samples --objective flip --size 64x32 \
                    --samples-per-pixel 16 --out tuned --budget 3";

const REPORT: &str = "report tuned --html page.html";

#[test]
fn a_journal_with_an_impossible_trial_is_refused_with_its_line_and_left_unchanged() {
    let sandbox = Sandbox::new();
    sandbox.done(TUNE);
    let path = sandbox.path("tuned/journal.jsonl");
    let whole = fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = whole.lines().collect();
    assert_eq!(lines.len(), 4);
    fs::remove_file(sandbox.path("tuned/tune.json")).unwrap();
    let refused = |text: &str, commands: &[&str], parts: &[&str]| {
        fs::write(&path, text).unwrap();
        for command in commands {
            sandbox.refuse(command, parts);
        }
        let now = fs::read_to_string(&path).unwrap();
        assert_eq!(now, text, "the journal was changed");
    };
    for row in rows(include_str!("refusals.toml"), "journal") {
        let (line, pointer): (usize, &str) = (row[0].parse().unwrap(), row[1]);
        let mut changed: Value = serde_json::from_str(lines[line - 1]).unwrap();
        let value = changed.pointer_mut(pointer.trim_start_matches("tune "));
        *value.expect(pointer) = serde_json::from_str(row[2]).unwrap();
        let changed = changed.to_string();
        let mut edited = lines.clone();
        edited[line - 1] = &changed;
        let commands = [TUNE, REPORT];
        let commands = &commands[..if pointer.starts_with("tune") { 1 } else { 2 }];
        let place = format!("journal.jsonl:{line}");
        refused(&(edited.join("\n") + "\n"), commands, &[&place, row[3]]);
    }
    let [deep, long] = ["[".repeat(100_000), "x".repeat(1 << 20)].map(|text| text + "\n");
    let none = "no journal of a tuning";
    for (text, found) in [
        (&*deep, none),
        (&long, none),
        ("my notes, without an end of line", none),
        ("first line\nsecond line\n", none),
        ("{\"format\":1}\nand half a line", "begun with another"),
    ] {
        let parts = ["journal.jsonl:1:", found, "another output folder"];
        refused(text, &[TUNE], &parts);
    }
    #[cfg(unix)]
    {
        fs::remove_file(&path).unwrap();
        make_fifo(&path);
        for command in [TUNE, REPORT] {
            sandbox.refuse(command, &["journal.jsonl", "FIFO"]);
        }
    }
}
