//! The time that commands announce before long work, and that README.md says.

use std::io::{BufRead, BufReader};
use std::process::Stdio;

use tests::text::assert_contains;

use crate::sandbox::{Sandbox, quick_command, split, stderr};

const README: &str = include_str!("../../README.md");
const MAKEFILE: &str = include_str!("../../Makefile");

/// Runs a command on two threads until it says how long it will take; returns the time.
#[track_caller]
fn read_expected(sandbox: &Sandbox, line: &str) -> String {
    let mut command = sandbox.command(&[&split(line)[..], &["--threads", "2"]].concat());
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let lines = BufReader::new(child.stderr.take().unwrap()).lines();
    let mut said = Vec::new();
    // The next line may take minutes.
    for line in lines.map_while(Result::ok) {
        said.push(line);
        if said
            .last()
            .is_some_and(|line| line.starts_with("expected: "))
        {
            break;
        }
    }
    _ = child.kill();
    _ = child.wait();
    let last = said.last().map_or("", String::as_str);
    let time = last.strip_prefix("expected: about ");
    let time = time.and_then(|time| time.split_once(" on 2 cores, "));
    time.unwrap_or_else(|| panic!("{line}: {said:?}"))
        .0
        .to_owned()
}

#[test]
#[ignore = "prove: every command of the README, until it says its time"]
fn the_times_of_the_readme_are_those_that_the_program_announces() {
    let sandbox = Sandbox::of(&Vec::new());
    sandbox.done("new my_blur --from wgsl");
    let mut count = 0;
    // Rows of the table, and commands with comments: `.. # about 2 min: ..`.
    let rows = README.lines().filter_map(|row| {
        let cells: Vec<&str> = row.split(" | ").collect();
        let command = cells.get(1)?.strip_prefix("`shuttertruth ")?;
        Some((command.trim_end_matches('`').to_owned(), *cells.get(2)?))
    });
    let scenes = MAKEFILE
        .lines()
        .find_map(|line| line.strip_prefix("SCENES ?= "));
    let of_make = format!("run {} --samples-per-pixel 64", scenes.unwrap());
    let commented = README.lines().filter_map(|line| {
        let (command, comment) = line.trim_start().split_once(" # about ")?;
        let command = command.trim_end();
        let command = match command.strip_prefix("shuttertruth ") {
            None if command == "make run" => of_make.clone(),
            command => command?.to_owned(),
        };
        Some((command, comment.split(':').next()?))
    });
    for (command, time) in rows.chain(commented).filter(|(_, time)| !time.is_empty()) {
        count += 1;
        assert_eq!(read_expected(&sandbox, &command), time, "{command}");
    }
    assert!(count >= 5, "README.md says {count} times");
}

#[test]
fn commands_that_measure_kept_runs_announce_their_time_too() {
    let sandbox = Sandbox::new();
    sandbox.measure("--filters velocity_gather:fine");
    // A claimed size makes the comparison long; its pictures are as small as before.
    sandbox.measure_into(
        "other",
        "--filters velocity_gather:fine --set velocity_gather.samples=2",
    );
    for out in ["out", "other"] {
        let run = sandbox.text(&format!("{out}/run.json"));
        let large = run
            .replace("\"width\": 64", "\"width\": 8192")
            .replace("\"height\": 32", "\"height\": 4096");
        assert_ne!(run, large);
        sandbox.put(&format!("{out}/run.json"), large);
    }
    let compared = stderr(&sandbox.shuttertruth(&split("compare out other")));
    assert_contains(&compared, &["expected: about ", "changed case"]);
    sandbox.put("params.json", "{}");
    let words = "tune evaluate --filter velocity_gather --params params.json --size 1280x720";
    let words = [&split(words)[..], &["--out", "tuned"]].concat().join(" ");
    assert!(!read_expected(&sandbox, &words).is_empty());
    // Short work is not announced.
    let short = sandbox
        .shuttertruth(&[&quick_command("run", "16")[1..], &["--filter", "identity"]].concat());
    assert!(!stderr(&short).contains("expected: "));
}
