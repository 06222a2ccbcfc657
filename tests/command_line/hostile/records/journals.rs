//! Edited journals of `tune`.

use std::fs;

use serde_json::{Value, json};

use crate::sandbox::{Sandbox, assert_refused, make_fifo, split};

const TUNE: &str = "tune search --quiet --filter jump_flood --vary samples --objective flip --size 64x32 \
                    --samples-per-pixel 16 --out tuned --budget 3";

#[test]
fn a_journal_with_an_impossible_trial_is_refused_with_its_line_and_left_unchanged() {
    let sandbox = Sandbox::new();
    let words = TUNE.to_owned();
    sandbox.execute(&split(&words));
    let path = sandbox.path("tuned/journal.jsonl");
    let whole = fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = whole.lines().collect();
    assert_eq!(lines.len(), 4);
    fs::remove_file(sandbox.path("tuned/tune.json")).unwrap();

    // Line, pointer, value, expected message, and whether the report also refuses it, which knows no filter.
    for (line, pointer, value, found, in_report) in [
        (2, "/trial", json!(7), "trial 7, expected 0", true),
        (3, "/values/samples", json!(-5), "samples", false),
        (3, "/values/samples", json!("many"), "samples", false),
        (
            3,
            "/values",
            json!({}),
            "it changes nothing, and this tuning samples",
            true,
        ),
        (3, "/values", json!({"bogus": 1}), "it changes bogus", true),
        (2, "/scenes", json!({}), "it has 0 of 1 scenes", true),
        (
            3,
            "/scenes",
            json!({"moon": {"flip": 0.1}}),
            "it ran on moon",
            true,
        ),
        (
            2,
            "/scenes/plate/flip",
            json!(-1.0),
            "flip is -1; allowed: 0 to 1",
            true,
        ),
        (
            2,
            "/scenes/plate/flip",
            json!(1e300),
            "allowed: 0 to 1",
            true,
        ),
        (
            2,
            "/error",
            Value::Null,
            "it has 1 of 1 scenes, and no error",
            true,
        ),
        (
            2,
            "/outcome",
            json!({"is": "failed", "reason": "a"}),
            "the first is done",
            true,
        ),
        (2, "/outcome", json!({"is": "sung"}), "no", true),
        (2, "/loss", Value::Null, "no", true),
    ] {
        let mut changed: Value = serde_json::from_str(lines[line - 1]).unwrap();
        *changed.pointer_mut(pointer).unwrap() = value;
        let changed = changed.to_string();
        let mut edited = lines.clone();
        edited[line - 1] = &changed;
        let edited = edited.join("\n") + "\n";
        fs::write(&path, &edited).unwrap();
        let place = format!("journal.jsonl:{line}");
        assert_refused(&sandbox.shuttertruth(&split(&words)), 2, &[&place, found]);
        assert_eq!(
            fs::read_to_string(&path).unwrap(),
            edited,
            "the journal was changed"
        );
        if in_report {
            let report = sandbox.shuttertruth(&["report", "tuned", "--html", "page.html"]);
            assert_refused(&report, 2, &[&place, found]);
        }
    }
    for (text, found) in [
        ("[".repeat(100_000) + "\n", "no journal of a tuning"),
        ("x".repeat(1 << 20) + "\n", "no journal of a tuning"),
    ] {
        fs::write(&path, &text).unwrap();
        assert_refused(
            &sandbox.shuttertruth(&split(&words)),
            2,
            &["journal.jsonl:1", found],
        );
        assert_eq!(fs::read_to_string(&path).unwrap(), text);
    }
    #[cfg(unix)]
    {
        fs::remove_file(&path).unwrap();
        make_fifo(&path);
        assert_refused(
            &sandbox.shuttertruth(&split(&words)),
            2,
            &["journal.jsonl", "FIFO"],
        );
        let report = sandbox.shuttertruth(&["report", "tuned", "--html", "page.html"]);
        assert_refused(&report, 2, &["journal.jsonl", "FIFO"]);
    }
}
