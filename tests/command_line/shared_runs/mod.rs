//! Runs shared by several processes: the plan, its jobs, and the merge of their results.

mod refusals;
mod same_bytes;

use serde_json::Value;

use crate::sandbox::Sandbox;

/// Filters of both shutters, one of them with two presets.
const FILTERS: &str = "velocity_gather:fine,velocity_gather:coarse,kino:default";

/// Options that measure very quickly.
pub const QUICK: &str = "--quiet --size 64x32 --samples-per-pixel 16 --jitter-frames 2";

/// Plans a command; returns one job per line.
fn plan(sandbox: &Sandbox, words: &str) -> Vec<Value> {
    let text = sandbox.done(&format!("truths plan {words} --json"));
    let lines = text.lines().map(|line| serde_json::from_str(line).unwrap());
    lines.collect()
}

/// Lists texts of a job.
fn list(job: &Value, key: &str) -> Vec<String> {
    serde_json::from_value(job[key].clone()).unwrap()
}

/// Runs a job with existing inputs, which must leave all its outputs. Returns its messages.
#[track_caller]
fn execute(sandbox: &Sandbox, job: &Value) -> String {
    let assert_files = |key: &str| {
        for file in list(job, key) {
            assert!(sandbox.path(&file).is_file(), "{}: no {file}", job["job"]);
        }
    };
    assert_files("inputs");
    let printed = sandbox.done(&list(job, "arguments").join(" "));
    assert_files("outputs");
    printed
}

/// Measures two scenes in one folder each, with one filter and the references; and another filter without them.
fn parts() -> Sandbox {
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
