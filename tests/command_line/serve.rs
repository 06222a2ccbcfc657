//! `serve` and `evaluate`: searches driven by other programs.

use std::collections::BTreeSet;
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{ChildStdin, Command, Stdio};

use serde_json::{Value, json};
use tests::text::assert_contains;

use crate::child::wait_until;
use crate::sandbox::{Sandbox, python_with, read_table, split, stderr, stdout};

pub const SERVE: &str = "tune serve --quiet --filter jump_flood --objective flip --size 64x32 \
    --samples-per-pixel 16 --out out";

/// Sends the lines one by one and reads all answers.
fn converse(sandbox: &Sandbox, lines: &[Value]) -> Vec<Value> {
    let mut command = sandbox.command(&split(SERVE));
    command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let mut input: ChildStdin = child.stdin.take().unwrap();
    for line in lines {
        match line {
            Value::String(text) => writeln!(input, "{text}").unwrap(),
            json => writeln!(input, "{json}").unwrap(),
        }
    }
    drop(input);
    let output = BufReader::new(child.stdout.take().unwrap());
    let heard = output.lines().map(Result::unwrap);
    let heard: Vec<Value> = heard
        .map(|line| serde_json::from_str(&line).unwrap())
        .collect();
    assert!(child.wait().unwrap().success());
    heard
}

#[test]
fn requests_get_answers_and_bad_or_cancelled_ones_none() {
    let requests = [
        json!({"id": 7, "params": {"samples": 12}}),
        json!("samples = 3"),
        json!({"id": 1, "params": {"sample": 3}}),
        json!({"id": 4, "params": {"samples": 0}}),
        json!({"id": 5, "params": {}, "scenes": ["fan"]}),
        json!({"id": 6, "params": {}, "scenes": []}),
        json!({"cancel": 2}),
        json!({"id": 2, "params": {"samples": 3}}),
        // JSON has only one kind of number: a whole one is also a real one.
        json!({"id": 3, "params": {"samples": 4, "match_threshold": 1}}),
    ];
    let heard = converse(&Sandbox::new(), &requests);
    assert_eq!(heard[0]["ready"], true);
    assert_eq!(heard[0]["scenes"], json!(["plate"]));
    let of = |id: u64| -> Vec<&Value> { heard.iter().filter(|line| line["id"] == id).collect() };
    // One answer per scene, and then a summary.
    let [scene, summary] = of(7)[..] else {
        panic!("one scene: {heard:?}");
    };
    assert_eq!(scene["scene"], "plate");
    let done = &summary["done"];
    assert_eq!(done["values"]["samples"], 12);
    assert_eq!(done["scenes"]["plate"]["flip"], scene["flip"]);
    let error = done["error"].as_f64().unwrap();
    assert!(error != 0.0, "it differs from the start");

    let errors = heard.iter().filter_map(|line| line["error"].as_str());
    let errors: Vec<&str> = errors.collect();
    let parts = "allowed are {\"id\": 7|sample|from 1 to 64|allowed: plate|name at least one";
    let parts: Vec<&str> = parts.split('|').collect();
    assert_eq!(errors.len(), parts.len(), "{heard:?}");
    for (error, part) in errors.iter().zip(parts) {
        assert_contains(error, &[part]);
    }
    assert_eq!(of(2), [&json!({"id": 2, "cancelled": true})]);
    let last = &of(3).pop().unwrap()["done"];
    assert_eq!(last["values"]["match_threshold"], 1.0);
}

#[test]
fn parameters_of_a_file_are_checked() {
    let sandbox = Sandbox::new();
    let words = "tune evaluate --quiet --filter jump_flood --params p.json --out out";
    for (text, parts) in read_table("parameters of requests") {
        sandbox.put("p.json", text);
        sandbox.refuse(words, &parts);
    }
    fs::remove_file(sandbox.path("p.json")).unwrap();
    sandbox.refuse(words, &["p.json: cannot read"]);
    assert!(!sandbox.path("out").exists());
}

/// Makes the example's command, which finds the program on its PATH; `more` are options of the example.
fn optuna(sandbox: &Sandbox, more: &[&str]) -> Command {
    let example = tests::root().join("examples/optuna_tune.py");
    let program = Path::new(env!("CARGO_BIN_EXE_shuttertruth"));
    let path = std::env::var("PATH").unwrap_or_default();
    let mut command = Command::new(python_with(&["optuna"]));
    command.current_dir(sandbox.path(""));
    command.arg(example).args(more);
    let folder = program.parent().unwrap().display();
    command.env("PATH", format!("{folder}:{path}"));
    let words = SERVE.replace("flip ", "flip,bleed ");
    command.args(&split(&words)[2..]);
    command
}

#[test]
fn optuna_finds_something_better_through_the_service() {
    let sandbox = Sandbox::new();
    let output = optuna(&sandbox, &[]).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let found: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let all = found.as_array().unwrap().iter();
    let errors = all.map(|best| best[0][0].as_f64().unwrap());
    let least = errors.fold(f64::INFINITY, f64::min);
    assert!(least < 0.0, "20 trials beat the start: {found}");
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
    // Both may have been in their last trial.
    let ended = count_ended(&journal);
    assert!((12..=13).contains(&ended), "{ended}");
}
