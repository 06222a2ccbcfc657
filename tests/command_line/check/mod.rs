//! `check`: bounds as their user meets them.

mod calibrated;
mod finished_run;
mod formats;
mod outcomes;
mod sequences;

use std::process::Output;

use crate::sandbox::{IDENTITY, Sandbox, stderr, stdout};

/// Makes a sandbox whose scene bounds the identity's `flip_moving`; the identity scores about 0.3.
fn make_bounded(limit: f64, level: &str) -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write("bounds.toml", &bound("flip_moving", limit, level));
    sandbox
}

fn bound(metric: &str, limit: f64, level: &str) -> String {
    format!(
        "[default]\n{metric} = {{ limit = {limit:?}, why = \"it serves a test\", level = \"{level}\" }}\n"
    )
}

#[track_caller]
fn assert_ends(output: &Output, code: i32, parts: &[&str]) -> String {
    let text = stdout(output);
    assert_eq!(output.status.code(), Some(code), "{text}{}", stderr(output));
    // Lines break at the width of the terminal.
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    for part in parts {
        let found = text.contains(part) || words.contains(part);
        assert!(found, "\"{part}\" is missing from:\n{text}");
    }
    text
}

/// Returns the last lines of a check as one line.
fn verdict(output: &Output) -> String {
    let text = stdout(output);
    let start = ["PASS", "FAIL", "UNDECIDED:"].map(|word| text.rfind(&format!("\n{word}")));
    let start = (start.into_iter().flatten().max()).expect("a verdict ends the check");
    let words: Vec<&str> = text[start..].split_whitespace().collect();
    words.join(" ")
}

fn json(sandbox: &Sandbox, more: &[&str]) -> serde_json::Value {
    let output = sandbox.check(&[&IDENTITY[..], &["--json"], more].concat());
    serde_json::from_slice(&output.stdout).unwrap()
}
