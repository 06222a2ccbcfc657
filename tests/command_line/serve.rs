//! `serve` and `evaluate`: searches that other programs drive.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{ChildStdin, Command, Stdio};

use serde_json::{Value, json};

use crate::bench::{Bench, assert_refused, split, stderr, stdout};

pub const SERVE: &str = "serve --quiet --filter jump_flood --objective flip --size 64x32 --samples-per-pixel 16 --out out";

/// Sends the lines one by one and reads all answers.
fn converse(bench: &Bench, more: &[&str], lines: &[Value]) -> Vec<Value> {
    let mut child = bench
        .command(&[&split(SERVE)[..], more].concat())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input: ChildStdin = child.stdin.take().unwrap();
    for line in lines {
        match line {
            Value::String(text) => writeln!(input, "{text}").unwrap(),
            json => writeln!(input, "{json}").unwrap(),
        }
    }
    drop(input);
    let output = BufReader::new(child.stdout.take().unwrap());
    let heard = output
        .lines()
        .map(|line| serde_json::from_str(&line.unwrap()).unwrap());
    let heard: Vec<Value> = heard.collect();
    assert!(child.wait().unwrap().success());
    heard
}

#[test]
fn a_request_gets_one_answer_per_scene_and_then_a_summary() {
    let bench = Bench::new();
    let heard = converse(&bench, &[], &[json!({"id": 7, "params": {"samples": 12}})]);
    assert_eq!(heard[0]["ready"], true);
    assert_eq!(heard[0]["scenes"], json!(["plate"]));
    assert_eq!(
        (&heard[1]["id"], &heard[1]["scene"]),
        (&json!(7), &json!("plate"))
    );
    let done = &heard[2]["done"];
    assert_eq!(done["values"]["samples"], 12);
    assert_eq!(done["scenes"]["plate"]["flip"], heard[1]["flip"]);
    assert!(
        done["error"].as_f64().unwrap() != 0.0,
        "it differs from the start"
    );
    assert_eq!(heard.len(), 3);
}

#[test]
fn a_bad_request_gets_an_error_and_the_service_goes_on() {
    let bench = Bench::new();
    let heard = converse(
        &bench,
        &[],
        &[
            json!("samples = 3"),
            json!({"id": 1, "params": {"sample": 3}}),
            json!({"id": 2, "params": {"samples": 0}}),
            json!({"id": 3, "params": {}, "scenes": ["fan"]}),
            json!({"id": 4, "params": {}, "scenes": []}),
            json!({"id": 5, "params": {"match_threshold": 1}}),
        ],
    );
    let errors: Vec<&str> = heard
        .iter()
        .filter_map(|line| line["error"].as_str())
        .collect();
    let parts = [
        "allowed are {\"id\": 7",
        "sample",
        "from 1 to 64",
        "allowed: plate",
        "name at least one",
    ];
    assert_eq!(errors.len(), parts.len(), "{heard:?}");
    for (error, part) in errors.iter().zip(parts) {
        assert!(error.contains(part), "\"{part}\" is missing from: {error}");
    }
    // A whole number is also a real one.
    assert_eq!(
        heard.last().unwrap()["done"]["values"]["match_threshold"],
        1.0
    );
}

#[test]
fn a_cancelled_request_gets_no_summary() {
    let bench = Bench::new();
    let heard = converse(
        &bench,
        &[],
        &[
            json!({"cancel": 2}),
            json!({"id": 2, "params": {"samples": 3}}),
            // JSON has only one kind of number.
            json!({"id": 3, "params": {"samples": 4, "match_threshold": 1}}),
        ],
    );
    let of = |id: u64| {
        heard
            .iter()
            .filter(move |line| line["id"] == id)
            .collect::<Vec<_>>()
    };
    assert_eq!(of(2), [&json!({"id": 2, "cancelled": true})]);
    assert!(of(3).last().unwrap()["done"].is_object());
}

#[test]
fn parameters_of_a_file_are_checked() {
    let bench = Bench::new();
    let evaluate = |text: &str| {
        fs::write(bench.path("p.json"), text).unwrap();
        let words = split("evaluate --quiet --filter jump_flood --params p.json");
        bench.shuttertruth(&[&words[..], &["--out", "out"]].concat())
    };
    for (text, parts) in [
        (
            "{\"sample\": 3}",
            ["p.json: jump_flood.sample", "allowed: samples"],
        ),
        (
            "{\"samples\": 3.5}",
            ["p.json: jump_flood.samples: found 3.5", "from 1 to 64"],
        ),
        (
            "samples = 3",
            ["p.json", "allowed: one table of parameters"],
        ),
    ] {
        assert_refused(&evaluate(text), 2, &parts);
    }
    fs::remove_file(bench.path("p.json")).unwrap();
    let words = split("evaluate --filter jump_flood --params p.json --out out");
    assert_refused(&bench.shuttertruth(&words), 2, &["p.json: cannot be read"]);
    assert!(!bench.path("out").exists());
}

/// `make test` installs Optuna and names its Python in PYTHON.
#[test]
fn optuna_finds_something_better_through_the_service() {
    let python = std::env::var("PYTHON").unwrap_or("python3".to_owned());
    let has_optuna = Command::new(&python).args(["-c", "import optuna"]).output();
    assert!(
        has_optuna.is_ok_and(|output| output.status.success()),
        "{python} has no Optuna: `make test` installs it; or pip install optuna, and set PYTHON to the Python that has it"
    );
    let bench = Bench::new();
    let example = tests::root().join("examples/optuna_tune.py");
    let program = Path::new(env!("CARGO_BIN_EXE_shuttertruth"))
        .parent()
        .unwrap();
    let path = std::env::var("PATH").unwrap_or_default();
    let mut command = Command::new(python);
    command.current_dir(bench.path("")).arg(example);
    command.env("PATH", format!("{}:{path}", program.display()));
    let words = SERVE.replace("flip ", "flip,bleed ");
    let output = command.args(&split(&words)[1..]).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let found: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let errors = found
        .as_array()
        .unwrap()
        .iter()
        .map(|best| best[0][0].as_f64().unwrap());
    let least = errors.fold(f64::INFINITY, f64::min);
    assert!(least < 0.0, "20 trials beat the start: {found}");
}
