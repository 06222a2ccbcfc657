//! `check`: bounds as users see them, and limits that `calibrate` proposes.

mod formats;
mod outcomes;
mod sequences;

use std::fs;
use std::process::Output;

use tests::text::{assert_contains, squeeze};

use crate::sandbox::{Sandbox, split, stderr, stdout};

/// A bound that the identity keeps.
const KEPT: &str = "label_tv = { limit = 0.9, why = \"it serves a test\" }\n";

/// Makes a sandbox whose scene bounds the identity's `flip_moving`, which is about 0.3, with the
/// identity already measured.
fn make_bounded(limit: f64, level: &str) -> Sandbox {
    let sandbox = Sandbox::checked();
    sandbox.write("bounds.toml", &bound("flip_moving", limit, level));
    sandbox
}

fn bound(metric: &str, limit: f64, level: &str) -> String {
    let why = "why = \"it serves a test\"";
    format!("[default]\n{metric} = {{ limit = {limit:?}, {why}, level = \"{level}\" }}\n")
}

/// Checks the identity.
#[track_caller]
fn check<T: AsRef<str>>(sandbox: &Sandbox, more: &str, code: i32, parts: &[T]) -> String {
    let output = sandbox.check(&split(&format!("--filters identity {more}")));
    assert_ends(&output, code, parts)
}

#[track_caller]
fn assert_ends<T: AsRef<str>>(output: &Output, code: i32, parts: &[T]) -> String {
    let text = stdout(output);
    assert_eq!(output.status.code(), Some(code), "{text}{}", stderr(output));
    assert_contains(&format!("{text}\n{}", squeeze(&text)), parts);
    text
}

fn json(sandbox: &Sandbox, more: &str) -> serde_json::Value {
    let output = sandbox.check(&split(&format!("--json {more}")));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Proposes limits of a gather on the plate; returns the output, and the file.
pub fn calibrate(sandbox: &Sandbox, more: &str) -> (String, String) {
    let words = "limits calibrate --quiet --out calibrated --size 64x32 --samples-per-pixel 64 \
        --runs 2 --filters";
    let printed = sandbox.done(&format!("{words} velocity_gather:fine {more}"));
    let file = sandbox.path("calibrated/plate.bounds.toml");
    (printed, fs::read_to_string(file).unwrap())
}

/// Checks that the gather keeps its limits with a seed that neither run used, and that two taps
/// break them.
pub fn assert_limits(sandbox: &Sandbox, more: &str, met: &str, broken: &str) {
    let fine = format!("--filters velocity_gather:fine --seed 9 {more}");
    assert_ends(&sandbox.check(&split(&fine)), 0, &[met]);
    let worse = format!("{fine} --set velocity_gather.samples=2");
    assert_ends(&sandbox.check(&split(&worse)), 1, &[broken]);
}

#[test]
fn calibrated_limits_pass_the_filter_and_fail_a_worse_one() {
    let sandbox = Sandbox::new();
    let metrics = "flip_moving,misplacement,bleed_leading,extent,psnr_moving";
    let (printed, proposed) = calibrate(&sandbox, &format!("--metrics {metrics}"));
    assert!(printed.contains(&proposed));
    assert_eq!(proposed.matches("limit = ").count(), 5, "{proposed}");
    sandbox.write("bounds.toml", &proposed);
    let met = "5 required bounds: 5 met";
    assert_limits(&sandbox, "", met, "BROKEN flip_moving");
}

#[test]
fn limits_are_for_bounded_metrics_and_those_that_notice_changes_of_a_kernel_unless_named() {
    let sandbox = Sandbox::new();
    sandbox.write_bound(0.9);
    let (_, proposed) = calibrate(&sandbox, "");
    let limits = (proposed.lines()).filter_map(|line| line.split_once(" = { limit"));
    let mut names: Vec<&str> = limits.map(|(name, _)| name).collect();
    names.sort_unstable();
    let noticing = split("deficit gather_spread label_tv_p95 static_contamination");
    assert_contains(&sandbox.done("limits calibrate --help"), &noticing);
    let mut due = [&noticing[..], &["flip_moving"]].concat();
    due.sort_unstable();
    assert_eq!(names, due);
}
