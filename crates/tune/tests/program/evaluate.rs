//! `tune evaluate`: searches driven by other programs.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

use serde_json::Value;

use crate::child::wait_until;
use crate::sandbox::{Sandbox, python_with, split, stderr, stdout};

const EVALUATE: &str =
    "tune evaluate --quiet --filter jump_flood --size 64x32 --samples-per-pixel 16 --out out";

#[test]
fn a_file_of_parameters_is_scored_on_every_scene() {
    let sandbox = Sandbox::new();
    // JSON has only one kind of number: a whole one is also a real one.
    sandbox.put("p.json", "{\"samples\": 12, \"match_threshold\": 1}");
    let printed = sandbox.done(&format!("{EVALUATE} --objective flip --params p.json"));
    let scores: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(scores["values"]["samples"], 12);
    assert_eq!(scores["values"]["match_threshold"], 1.0);
    let flip = scores["scenes"]["plate"]["flip"].as_f64().unwrap();
    assert!(flip > 0.0 && flip < 1.0, "{flip}");
    assert_ne!(scores["error"], 0.0, "it differs from the start");
}

/// Files of parameters, and parts of the message.
const BAD_PARAMETERS: [(&str, &[&str]); 3] = [
    (
        r#"{"sample": 3}"#,
        &["p.json: jump_flood.sample", "allowed: samples"],
    ),
    (
        r#"{"samples": 3.5}"#,
        &["p.json: jump_flood.samples: found 3.5", "from 1 to 64"],
    ),
    (
        "samples = 3",
        &["p.json", "allowed: one table of parameters"],
    ),
];

#[test]
fn parameters_of_a_file_are_checked() {
    let sandbox = Sandbox::new();
    let words = "tune evaluate --quiet --filter jump_flood --params p.json --out out";
    for (text, parts) in BAD_PARAMETERS {
        sandbox.put("p.json", text);
        sandbox.refuse(words, parts);
    }
    fs::remove_file(sandbox.path("p.json")).unwrap();
    sandbox.refuse(words, &["p.json: cannot read"]);
    assert!(!sandbox.path("out").exists());
}

/// Makes the example's command, which finds the program on its PATH; `more` are options of the
/// example.
fn optuna(sandbox: &Sandbox, more: &[&str]) -> Command {
    let example = tests::root().join("examples/optuna_tune.py");
    let program = Path::new(env!("CARGO_BIN_EXE_shuttertruth"));
    let path = std::env::var("PATH").unwrap_or_default();
    let mut command = Command::new(python_with(&["optuna"]));
    command.current_dir(sandbox.path(""));
    command.arg(example).args(more);
    let folder = program.parent().unwrap().display();
    command.env("PATH", format!("{folder}:{path}"));
    command.args(&split(EVALUATE)[3..]);
    command.args(["--objective", "flip,bleed"]);
    command
}

#[test]
#[ignore = "prove: a search by Optuna"]
fn optuna_finds_something_better() {
    let sandbox = Sandbox::new();
    let output = optuna(&sandbox, &[]).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let best_trials: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let all = best_trials.as_array().unwrap().iter();
    let errors = all.map(|best| best[0][0].as_f64().unwrap());
    let least = errors.fold(f64::INFINITY, f64::min);
    assert!(least < 0.0, "20 trials beat the start: {best_trials}");
}

/// Reads the complete operations of a study's journal.
fn read_journal(sandbox: &Sandbox) -> Vec<Value> {
    let text = fs::read_to_string(sandbox.path("study.log")).unwrap_or_default();
    let lines = text
        .lines()
        .map_while(|line| serde_json::from_str(line).ok());
    lines.collect()
}

/// Finds the workers that began a trial.
fn find_workers(journal: &[Value]) -> BTreeSet<&str> {
    // Optuna's number of the operation.
    let began = journal.iter().filter(|entry| entry["op_code"] == 4);
    let workers = began.map(|entry| entry["worker_id"].as_str().unwrap());
    workers.collect()
}

/// Counts the trials that ended.
fn count_ended(journal: &[Value]) -> usize {
    // Optuna's numbers of the operation, and of the states COMPLETE and PRUNED.
    let has_ended =
        |entry: &&Value| entry["op_code"] == 6 && (entry["state"] == 1 || entry["state"] == 2);
    journal.iter().filter(has_ended).count()
}

#[test]
fn two_workers_share_a_study_and_one_goes_on_when_the_other_is_killed() {
    let sandbox = Sandbox::new();
    let words = ["--journal", "study.log", "--trials", "12"];
    let start = || {
        let mut command = optuna(&sandbox, &words);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command.spawn().unwrap()
    };
    let [mut killed, other] = [(); 2].map(|()| start());
    wait_until(&mut killed, || {
        let journal = read_journal(&sandbox);
        find_workers(&journal).len() == 2 && count_ended(&journal) >= 2
    });
    // Optuna waits 30 s for a worker that dies while it writes. A trial takes longer than this.
    thread::sleep(Duration::from_millis(100));
    killed.kill().unwrap();
    killed.wait().unwrap();
    let before = count_ended(&read_journal(&sandbox));
    assert!(before < 12, "the study ended before a worker was killed");

    let output = other.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let best: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert!(!best.as_array().unwrap().is_empty());
    let journal = read_journal(&sandbox);
    assert_eq!(find_workers(&journal).len(), 2);
    // Both workers may have been in their last trial.
    let ended = count_ended(&journal);
    assert!((12..=13).contains(&ended), "{ended}");
}
