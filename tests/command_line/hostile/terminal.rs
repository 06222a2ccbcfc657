//! Output to terminals, logs and summaries: hostile names and messages, and closed pipes.

use std::fs;
use std::path::Path;
use std::process::{Output, Stdio};

use cli::{annotations, check_text, summary, terminal_text};
use frame::{Alignment, Frame, Truth};
use judge::{CHECK_FORMAT, Check, Decision};
use suite::Failure;
use tests::text::assert_contains;
use tracer::SceneId;

use crate::sandbox::{Sandbox, assert_done, assert_refused, split, stderr, stdout};

/// Folder name that starts a line like a GitHub Actions command, and clears a terminal.
#[cfg(unix)]
const HOSTILE: &str = "a\n::error::b\u{1b}[2J";

/// Asserts that a log would take no line of a text for a command.
#[track_caller]
fn assert_no_command(text: &str) {
    for line in text.lines() {
        assert!(!line.trim_start().starts_with("::"), "{text}");
    }
}

/// Asserts that the output has no escape codes and no such line.
#[track_caller]
pub fn assert_tame(output: &Output) {
    for text in [stdout(output), stderr(output)] {
        let is_code = |letter: char| letter.is_control() && letter != '\n';
        assert!(!text.contains(is_code), "{text:?}");
        assert_no_command(&text);
    }
}

#[cfg(unix)]
#[test]
fn names_of_files_are_printed_without_control_codes() {
    let sandbox = Sandbox::measured();
    let below = |name: &str| format!("{HOSTILE}/{name}");
    fs::create_dir_all(sandbox.path(&below("scene"))).unwrap();
    sandbox.put(&below("run.json"), "no run");
    let scene = "family = \"a\n::error::c\"\n";
    sandbox.put(&below("scene/scene.toml"), scene);
    // The name is the last word.
    for line in [
        "run --out o --scenes-dir",
        "run --out o --scenes",
        "run --out o --size",
        "list --scenes-dir",
        "report --html p.html",
        "engine blur --filter identity --out b.exr --frame",
    ] {
        let output = sandbox.shuttertruth(&[&split(line)[..], &[HOSTILE]].concat());
        assert_refused(&output, 2, &["::error::b"]);
        assert_tame(&output);
    }
    for html in [below("p.html"), below("q.html")] {
        let written = sandbox.shuttertruth(&["report", "out", "--html", &html]);
        assert_done(&written);
        assert_tame(&written);
        assert_contains(&stdout(&written), &["a\\n::error::b\\u001b[2J"]);
    }
    let scenes = sandbox.path("scenes");
    fs::rename(scenes.join("plate"), scenes.join(HOSTILE)).unwrap();
    let named = sandbox.run(&["--filters", "identity"]);
    let found = "the folder's name is the scene's, and it holds the control character U+000A";
    let parts = [found, "rename the folder"];
    assert_refused(&named, 2, &parts);
    assert_tame(&named);
}

#[test]
fn names_in_files_are_printed_without_control_codes() {
    let sandbox = Sandbox::measured();
    let name = "a\n::error::b\u{1b}]0;c\u{7}";
    let score = split(
        "score --truth out/plate/truth_trailing.exr --frame out/plate/frame.exr --image \
         out/plate/identity_default/output.exr",
    );
    let path = sandbox.path("out/plate/truth_trailing.exr");
    let mut truth = Truth::read(&path).unwrap();
    truth.provenance.scene = name.to_owned();
    truth.write(&path).unwrap();
    let other = sandbox.shuttertruth(&score);
    assert_refused(&other, 2, &["was rendered from the scene plate"]);
    assert_tame(&other);
    let path = sandbox.path("out/plate/frame.exr");
    let mut frame = Frame::read(&path).unwrap();
    frame.provenance.scene = name.to_owned();
    frame.write(&path).unwrap();
    let scored = sandbox.shuttertruth(&score);
    assert_done(&scored);
    assert_tame(&scored);
    let json = sandbox.execute(&[&score[..], &["--json"]].concat());
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["scene"], name);
}

#[test]
fn names_in_a_run_are_printed_without_control_codes() {
    let sandbox = Sandbox::measured();
    let text = sandbox.text("out/run.json");
    let planted = text.replace("\"identity\"", "\"a\\u001b[35m\\u009b2J\"");
    assert_ne!(planted, text);
    sandbox.put("out/run.json", planted);
    sandbox.write_bound(0.2);
    for (line, code) in [("compare out out", 0), ("check out", 1)] {
        let output = sandbox.outside_ci(&split(line));
        assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
        assert_tame(&output);
        assert_contains(&stdout(&output), &["a\\u001b[35m\\u009b2J"]);
    }
}

#[test]
fn annotations_and_summaries_quote_failures_on_one_line() {
    let hostile = "a\n::error::b\u{1b}[2J\r![x](http://example.org/x)<img src=x>[y](javascript:z)";
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
    let begin = "::error title=a%0A%3A%3Aerror%3A%3Ab";
    assert!(lines.starts_with(begin), "{lines}");
    let failures = terminal_text(&check_text(&check, Path::new("out"), true));
    let markdown = summary(&check);
    for text in [&lines, &failures, &markdown] {
        assert!(!text.contains("\u{1b}[2J"), "{text:?}");
        assert!(!text.contains('\r'), "{text:?}");
    }
    for text in [&failures, &markdown] {
        assert_no_command(text);
    }
    for code in ["\u{1b}", "![x]", ")<img", "](javascript"] {
        assert!(!markdown.contains(code), "{markdown:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_closed_or_full_output_changes_an_exit_code_only_where_output_is_lost() {
    let sandbox = Sandbox::new();
    let wrong = "\"$0\" report nowhere --html p.html";
    let tune = "\"$0\" tune search --filter jump_flood --vary samples --objective flip --size 64x32 \
                --samples-per-pixel 16 --budget 1 --out tuned";
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
        let mut bash = std::process::Command::new("bash");
        bash.args(["-c", &line, env!("CARGO_BIN_EXE_shuttertruth")]);
        bash.stdout(Stdio::null()).stderr(Stdio::null());
        let status = bash.current_dir(sandbox.path(".")).status().unwrap();
        assert_eq!(status.code(), Some(code), "{line}");
    }
}
