//! Judgement of a finished run.

use std::fs;

use tests::text::{assert_contains, squeeze};

use super::{assert_ends, bound, check, make_bounded};
use crate::sandbox::{assert_refused, split, stderr};

#[test]
fn a_finished_run_is_judged_without_an_adapter() {
    let sandbox = make_bounded(0.2, "required");
    let broken = ["BROKEN flip_moving"];
    let made = check(&sandbox, "", 1, &broken);
    let judge = |line: &str| sandbox.without_adapter(&split(&format!("check {line}")));
    // The run wrote the page and its files already.
    let lines = made.split_inclusive('\n');
    let made: String = (lines.filter(|line| !line.starts_with("report: "))).collect();
    let note = "nothing was measured or verified now: the scores are those that out/run.json has\n";
    let judged = assert_ends(&judge("out/run.json --evidence"), 1, &[note]);
    assert_eq!(judged.replace(note, ""), made);
    let said = stderr(&judge("out/run.json --json"));
    assert_contains(&squeeze(&said), &[note.trim_end()]);
    // Evidence takes a while, so it is only made on request.
    let plain = assert_ends(&judge("out"), 1, &broken);
    assert!(!plain.contains("worst at"), "{plain}");

    sandbox.write("bounds.toml", &bound("flip_moving", 0.9, "required"));
    assert_ends(&judge("out"), 0, &["1 required bound: 1 met"]);
    assert_eq!(sandbox.read_findings()[0].limit, 0.9);

    let refuse = |line: &str, parts: &[&str]| assert_refused(&judge(line), 2, parts);
    let parts = ["elsewhere/plate", "no such scene", "--scenes-dir"];
    refuse("out --scenes-dir elsewhere", &parts);
    let parts = ["--size", "cannot be used with", "RUN"];
    refuse("out --size 64x32", &parts);
    fs::remove_file(sandbox.path("scenes/plate/bounds.toml")).unwrap();
    refuse("out", &["out/run.json", "none of its scores has a bound"]);
}

#[test]
fn a_judgement_of_another_run_is_refused() {
    let sandbox = make_bounded(0.2, "required");
    let run = sandbox.path("out/run.json");
    let text = fs::read_to_string(&run).unwrap();
    fs::write(&run, text.replace("\"seed\": 1,", "\"seed\": 2,")).unwrap();
    let row = " => judgement.json | about another run.json | shuttertruth check out/run.json";
    sandbox.refuse_rows("report out --html page.html", row);
}
