//! Output to terminals, logs and summaries: hostile names and messages, and closed pipes.

use std::fs;
use std::path::Path;
use std::process::{Output, Stdio};

use cli::{
    annotations, check_text, compare_table, ranking_text, run_table, summary, terminal_text,
};
use frame::{Alignment, Frame, Truth};
use judge::{CHECK_FORMAT, Check, Decision, check, compare_runs};
use suite::{Failure, StoredRun};
use tracer::SceneId;

use crate::sandbox::{Sandbox, assert_done, assert_refused, split, stderr, stdout};

/// Folder name that starts a line like a GitHub Actions command, and clears a terminal.
#[cfg(unix)]
const HOSTILE: &str = "a\n::error::b\u{1b}[2J";

/// Asserts that the output has no escape codes, and no line that a log would take for a command.
#[track_caller]
fn assert_tame(output: &Output) {
    for text in [stdout(output), stderr(output)] {
        assert!(
            !text
                .chars()
                .any(|letter| letter.is_control() && letter != '\n'),
            "{text:?}"
        );
        for line in text.lines() {
            assert!(!line.trim_start().starts_with("::error::"), "{text}");
        }
    }
}

#[cfg(unix)]
#[test]
fn names_of_files_are_printed_without_control_codes() {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&["--filters", "identity"]));
    fs::create_dir(sandbox.path(HOSTILE)).unwrap();
    let below = |name: &str| format!("{HOSTILE}/{name}");
    fs::write(sandbox.path(&below("run.json")), "no run").unwrap();
    fs::create_dir(sandbox.path(&below("scene"))).unwrap();
    fs::write(
        sandbox.path(&below("scene/scene.toml")),
        "family = \"a\n::error::c\"\n",
    )
    .unwrap();
    for (words, code) in [
        (vec!["run", "--out", "o", "--scenes-dir", HOSTILE], 2),
        (vec!["run", "--out", "o", "--scenes", HOSTILE], 2),
        (vec!["list", "--scenes-dir", HOSTILE], 2),
        (vec!["report", HOSTILE, "--html", "p.html"], 2),
        (vec!["run", "--out", "o", "--size", HOSTILE], 2),
        (
            vec![
                "engine", "blur", "--filter", "identity", "--frame", HOSTILE, "--out", "b.exr",
            ],
            2,
        ),
    ] {
        let output = sandbox.shuttertruth(&words);
        assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
        assert_tame(&output);
        assert!(
            stderr(&output).contains("::error::b"),
            "{}",
            stderr(&output)
        );
    }
    for html in [below("p.html"), below("q.html")] {
        let written = sandbox.shuttertruth(&["report", "out", "--html", &html]);
        assert_done(&written);
        assert_tame(&written);
        assert!(stdout(&written).contains("a\\n::error::b\\u001b[2J"));
    }
    fs::rename(
        sandbox.path("scenes/plate"),
        sandbox.path("scenes").join(HOSTILE),
    )
    .unwrap();
    let named = sandbox.run(&["--filters", "identity"]);
    assert_refused(
        &named,
        2,
        &["the folder's name is the scene's", "rename the folder"],
    );
    assert_tame(&named);
}

#[test]
fn names_in_files_are_printed_without_control_codes() {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&["--filters", "identity"]));
    let name = "a\n::error::b\u{1b}]0;c\u{7}";
    let (truth, frame) = (
        sandbox.path("out/plate/truth_trailing.exr"),
        sandbox.path("out/plate/frame.exr"),
    );
    let mut altered = Truth::read(&truth).unwrap();
    altered.provenance.scene = name.to_owned();
    altered.write(&truth).unwrap();
    let words = split(
        "score --truth out/plate/truth_trailing.exr --frame out/plate/frame.exr --image \
         out/plate/identity_default/output.exr",
    );
    let other = sandbox.shuttertruth(&words);
    assert_refused(&other, 2, &["was rendered from the scene plate"]);
    assert_tame(&other);
    let mut altered = Frame::read(&frame).unwrap();
    altered.provenance.scene = name.to_owned();
    altered.write(&frame).unwrap();
    let scored = sandbox.shuttertruth(&words);
    assert_done(&scored);
    assert_tame(&scored);
    let json = sandbox.shuttertruth(&[&words[..], &["--json"]].concat());
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(json["scene"], name);
}

#[test]
fn names_in_a_run_are_printed_without_control_codes() {
    let sandbox = Sandbox::two_scenes();
    assert_done(&sandbox.run(&["--filters", "identity,jump_flood:paper"]));
    let name = "a\n::error::b\u{1b}[35m\u{9b}2J";
    let whole = StoredRun::read(&sandbox.path("out")).unwrap();
    let mut side = StoredRun::read(&sandbox.path("out")).unwrap();
    let first = side.run.cases[0].scene.clone();
    // Cases of the first scene stay, to be compared.
    for case in (side.run.cases.iter_mut()).filter(|case| case.scene != first) {
        case.id.scene = SceneId::new(name, None);
        case.id.filter = name.to_owned();
    }
    side.run.failures.push(Failure {
        scene: SceneId::new(name, None),
        filter: name.to_owned(),
        alignment: Alignment::Trailing,
        reason: name.to_owned(),
    });
    let go_on = |_| std::ops::ControlFlow::Continue(());
    let compared = compare_runs(&whole, &side, &std::collections::BTreeMap::new(), &go_on).unwrap();
    let checked = check(&side.run, Vec::new(), Vec::new());
    for text in [
        run_table(&side.run),
        ranking_text(&side.run.cases),
        compare_table(&compared),
        check_text(&checked, Path::new("out"), true),
    ] {
        let shown = terminal_text(&text);
        assert!(shown.contains("::error::b\\u001b[35m\\u009b2J"), "{shown}");
        assert!(
            !shown.contains("\u{1b}[35m") && !shown.contains('\u{9b}'),
            "{shown:?}"
        );
        let is_command = |line: &str| line.trim_start().starts_with("::error::");
        assert!(!shown.lines().any(is_command), "{shown}");
    }
    let styled = terminal_text(&run_table(&side.run));
    assert!(styled.contains("\u{1b}[1m"), "{styled:?}");

    let text = fs::read_to_string(sandbox.path("out/run.json")).unwrap();
    let planted = text.replace("\"jump_flood\"", "\"a\\u001b[35m\\u009b2J\"");
    assert_ne!(planted, text);
    fs::write(sandbox.path("out/run.json"), planted).unwrap();
    let compared = sandbox.shuttertruth(&["compare", "out", "out"]);
    assert_done(&compared);
    assert_tame(&compared);
    assert!(stdout(&compared).contains("a\\u001b[35m\\u009b2J"));
}

#[test]
fn annotations_and_summaries_quote_failures_on_one_line() {
    let hostile = "a\n::error::b\u{1b}[2J\r![x](http://example.org/x)<img src=x>";
    let check = Check {
        format: CHECK_FORMAT,
        program: suite::PROGRAM.to_owned(),
        decision: Decision::Broken,
        failures: vec![Failure {
            scene: SceneId::new(hostile, None),
            filter: hostile.to_owned(),
            alignment: Alignment::Trailing,
            reason: hostile.to_owned(),
        }],
        findings: Vec::new(),
        comparisons: Vec::new(),
    };
    let lines = annotations(&check);
    assert_eq!(lines.lines().count(), 1, "{lines}");
    assert!(
        lines.starts_with("::error title=a%0A%3A%3Aerror%3A%3Ab"),
        "{lines}"
    );
    let failures = terminal_text(&check_text(&check, Path::new("out"), true));
    for text in [&lines, &failures] {
        assert!(
            !text.contains("\u{1b}[2J") && !text.contains('\r'),
            "{text:?}"
        );
        let commands = text
            .lines()
            .filter(|line| line.trim_start().starts_with("::error::"));
        assert_eq!(commands.count(), 0, "{text}");
    }
    let markdown = summary(&check);
    assert!(
        !markdown.contains('\u{1b}') && !markdown.contains('\r'),
        "{markdown:?}"
    );
    assert!(
        !markdown.contains("![x]") && !markdown.contains(" <img"),
        "{markdown}"
    );
    assert!(
        !markdown.lines().any(|line| line.starts_with("::error::")),
        "{markdown}"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_closed_or_full_standard_error_changes_no_exit_code() {
    let sandbox = Sandbox::new();
    let program = env!("CARGO_BIN_EXE_shuttertruth");
    let shell = |line: &str| {
        let mut command = std::process::Command::new("bash");
        command
            .args(["-c", line, program])
            .current_dir(sandbox.path("."));
        command.stdout(Stdio::null()).stderr(Stdio::null());
        command.status().unwrap().code()
    };
    let wrong = "\"$0\" report nowhere --html p.html";
    let tune = "\"$0\" tune search --filter jump_flood --vary samples --objective flip --size 64x32 --samples-per-pixel 16 \
                --budget 1 --out tuned";
    let list = "\"$0\" list";
    for (line, code) in [
        (format!("{wrong} 2>&-"), 2),
        (format!("{wrong} 2>/dev/full"), 2),
        (format!("{wrong} 2> >(exec true); exit $?"), 2),
        (format!("{tune} 2>/dev/full"), 0),
        (format!("{tune} 2>&-"), 0),
        (format!("{list} >&-"), 0),
        (format!("{list} >&- 2>&-"), 0),
        (format!("{list} | head -1; exit ${{PIPESTATUS[0]}}"), 0),
        (format!("{list} >/dev/full"), 2),
        (format!("{list} >/dev/full 2>/dev/full"), 2),
    ] {
        assert_eq!(shell(&line), Some(code), "{line}");
    }
}
