//! Judgement of a finished run.

use std::fs;

use super::{IDENTITY, assert_ends, bound, make_bounded};
use crate::sandbox::{assert_refused, stderr};

#[test]
fn a_finished_run_is_judged_without_an_adapter() {
    let sandbox = make_bounded(0.2, "required");
    let made = assert_ends(&sandbox.check(&IDENTITY), 1, &["BROKEN flip_moving"]);
    let judge = |words: &[&str]| sandbox.without_adapter(&[&["check"], words].concat());
    // The run wrote the page already.
    let page = made.lines().find(|line| line.starts_with("report: "));
    let made = made.replace(&format!("{}\n", page.unwrap()), "");
    let judged = assert_ends(&judge(&["out/run.json", "--evidence"]), 1, &[]);
    let note = "nothing was measured or verified now: the scores are those that out/run.json has\n";
    assert!(judged.contains(note), "{judged}");
    assert_eq!(judged.replace(note, ""), made);
    let json = judge(&["out/run.json", "--json"]);
    let said = stderr(&json)
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ");
    assert!(said.contains(note.trim_end()), "{said}");
    // Evidence takes a while, so only who asks for it gets it.
    let plain = assert_ends(&judge(&["out"]), 1, &["BROKEN flip_moving"]);
    assert!(!plain.contains("worst at"), "{plain}");

    sandbox.write("bounds.toml", &bound("flip_moving", 0.9, "required"));
    assert_ends(&judge(&["out"]), 0, &["1 required bound: 1 met"]);
    assert_eq!(sandbox.read_findings()[0].limit, 0.9);

    let output = judge(&["out", "--scenes-dir", "elsewhere"]);
    assert_refused(
        &output,
        2,
        &["elsewhere/plate", "no such scene", "--scenes-dir"],
    );
    fs::remove_file(sandbox.path("scenes/plate/bounds.toml")).unwrap();
    assert_refused(
        &judge(&["out"]),
        2,
        &["out/run.json", "none of its scores has a bound"],
    );
    let output = judge(&["out", "--size", "64x32"]);
    assert_refused(&output, 2, &["--size", "cannot be used with", "RUN"]);
}

#[test]
fn a_judgement_of_another_run_is_refused() {
    let sandbox = make_bounded(0.2, "required");
    sandbox.check(&IDENTITY);
    let run = sandbox.path("out/run.json");
    let text = fs::read_to_string(&run).unwrap();
    fs::write(&run, text.replace("\"seed\": 1,", "\"seed\": 2,")).unwrap();
    let output = sandbox.shuttertruth(&["report", "out", "--html", "page.html"]);
    assert_refused(
        &output,
        2,
        &[
            "judgement.json",
            "about another run.json",
            "shuttertruth check out/run.json",
        ],
    );
}
