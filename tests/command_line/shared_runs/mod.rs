//! Runs that several processes share: the plan, its jobs, and the merge of what they made.

mod refusals;
mod same_bytes;

use serde_json::Value;

use crate::sandbox::{Sandbox, split};

/// Filters of both shutters, one of them with two presets.
const FILTERS: &str = "--filter velocity_gather,kino:default,identity";

/// Options that measure in next to no time.
const QUICK: &str = "--quiet --size 64x32 --samples-per-pixel 16 --jitter-frames 2";

/// Plans a command; returns one job per line.
fn plan(sandbox: &Sandbox, words: &[&str]) -> Vec<Value> {
    let text = sandbox.execute(&[&["truths", "plan"], words, &["--json"]].concat());
    let lines = text.lines().map(|line| serde_json::from_str(line).unwrap());
    lines.collect()
}

/// Lists texts of a job.
fn list(job: &Value, key: &str) -> Vec<String> {
    let texts = job[key].as_array().unwrap().iter();
    texts
        .map(|text| text.as_str().unwrap().to_owned())
        .collect()
}

/// Runs a job, whose inputs must be there; it must leave all its outputs. Returns what it prints.
#[track_caller]
fn execute(sandbox: &Sandbox, job: &Value) -> String {
    for input in list(job, "inputs") {
        assert!(sandbox.path(&input).is_file(), "{}: no {input}", job["job"]);
    }
    let words = list(job, "arguments");
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let printed = sandbox.execute(&words);
    for output in list(job, "outputs") {
        assert!(
            sandbox.path(&output).is_file(),
            "{}: no {output}",
            job["job"]
        );
    }
    printed
}

/// Measures two scenes in one folder each, with one filter and the references.
fn two_parts() -> Sandbox {
    let sandbox = Sandbox::two_scenes();
    for scene in ["plate", "slow"] {
        let out = ["--filter", "identity", "--scenes", scene, "--out", scene];
        sandbox.execute(&[&["run"], &split(QUICK)[..], &out].concat());
    }
    sandbox
}
