//! Baselines: accepted scores, and later scores held against them.

use std::fs;
use std::process::Output;

use crate::bench::{Bench, assert_done, assert_refused, stderr, stdout};

const FINE: [&str; 2] = ["--filters", "velocity_gather:fine"];
const COARSER: [&str; 2] = ["--set", "velocity_gather.samples=2"];
const BASELINE: [&str; 2] = ["--baseline", "base.json"];

/// Makes a bench with a margin, measures the fine gather and accepts it.
fn set_up() -> Bench {
    let bench = Bench::new();
    fs::write(
        bench.path("scenes/bounds.toml"),
        "[margin]\nflip_moving = 0.005\n",
    )
    .unwrap();
    assert_done(&run(&bench, &FINE));
    assert_done(&accept(&bench, &["--reason", "the first"]));
    bench
}

/// Runs `run` with the samples of a check.
fn run(bench: &Bench, more: &[&str]) -> Output {
    let words = [
        "run",
        "--quiet",
        "--out",
        "out",
        "--samples-per-pixel",
        "64",
    ];
    let size: &[&str] = match more.contains(&"--size") {
        true => &[],
        false => &["--size", "64x32"],
    };
    bench.shuttertruth(&[&words[..], size, more].concat())
}

fn accept(bench: &Bench, more: &[&str]) -> Output {
    let mut command = bench.command(&[&["limits", "accept", "--out", "out"], more].concat());
    command.env_remove("CI").output().unwrap()
}

fn check(bench: &Bench, more: &[&str]) -> Output {
    bench.check(&[&FINE[..], &BASELINE, more].concat())
}

fn baseline(bench: &Bench) -> serde_json::Value {
    bench.read_json("base.json")
}

#[test]
fn equal_scores_pass_and_worse_scores_are_reported() {
    let bench = set_up();
    let same = check(&bench, &[]);
    assert_done(&same);
    assert!(
        stdout(&same).contains("no worse: velocity_gather:fine flip_moving"),
        "{}",
        stdout(&same)
    );
    let worse = check(&bench, &COARSER);
    assert_eq!(worse.status.code(), Some(1), "{}", stdout(&worse));
    assert!(
        stdout(&worse).contains("WORSE: velocity_gather:fine samples=2 flip_moving, worse by 0.0"),
        "{}",
        stdout(&worse)
    );
    let margin = "[margin]\nflip_moving = 0.5\n";
    fs::write(bench.path("scenes/bounds.toml"), margin).unwrap();
    assert_done(&check(&bench, &COARSER));
}

#[test]
fn a_baseline_has_one_number_per_line_under_sorted_keys() {
    let bench = set_up();
    let text = fs::read_to_string(bench.path("base.json")).unwrap();
    let numbers: Vec<&str> = (text.lines().map(str::trim))
        .filter(|line| line.starts_with('"') && line.contains("\": ") && !line.ends_with('{'))
        .skip_while(|line| !line.starts_with("\"bleed"))
        .collect();
    assert!(numbers.len() > 20, "{text}");
    assert!(numbers.is_sorted(), "{numbers:#?}");
    let found = baseline(&bench);
    assert_eq!(found["reasons"][0], "the first");
    let run = bench.read_run();
    assert_eq!(found["adapter"]["name"], run.adapter.unwrap().name);
    assert_eq!(
        found["truths"]["plate"]["trailing"],
        run.cases[0].truth_hash
    );
    let before = text;
    assert_done(&accept(&bench, &["--reason", "the first"]));
    assert_eq!(fs::read_to_string(bench.path("base.json")).unwrap(), before);
}

#[test]
fn accept_names_its_run_and_newer_runs_of_other_sizes() {
    let bench = set_up();
    let first = accept(&bench, &["--reason", "again"]);
    let written = "written: base.json, from out/run.json (1 case at 64x32)\n";
    assert_eq!(
        (stdout(&first), stderr(&first)),
        (written.into(), "".into())
    );
    assert_done(&run(&bench, &["--size", "48x24", "--filters", "identity"]));
    let beside = accept(&bench, &["--reason", "again"]);
    assert_eq!(stdout(&beside), written);
    assert_eq!(
        stderr(&beside),
        "note: out/48x24 is newer, and is not accepted; to accept it instead: --out out/48x24\n"
    );
    let words = [
        "limits",
        "accept",
        "--out",
        "out/48x24",
        "--reason",
        "the other size",
    ];
    let other = bench.outside_ci(&words);
    let written = "written: base.json, from out/48x24/run.json (1 case at 48x24)\n";
    assert_eq!(
        (stdout(&other), stderr(&other)),
        (written.into(), "".into())
    );
    // A run that is not newer is no news.
    assert_done(&run(&bench, &FINE));
    assert_eq!(stderr(&accept(&bench, &["--reason", "again"])), "");
}

#[test]
fn accept_changes_only_the_named_cases() {
    let bench = set_up();
    let flip = |filter: &str| baseline(&bench)["scores"]["plate"][filter]["flip_moving"].clone();
    let before = flip("velocity_gather:fine");
    let both = ["--filters", "velocity_gather:fine,identity"];
    assert_done(&run(&bench, &[&both[..], &COARSER].concat()));
    let words = ["--only", "plate/ident*", "--reason", "one more"];
    assert_done(&accept(&bench, &words));
    assert_eq!(flip("velocity_gather:fine"), before);
    assert!(flip("identity:default").is_number());
    assert_eq!(
        baseline(&bench)["reasons"],
        serde_json::json!(["the first", "one more"])
    );
    assert_done(&accept(&bench, &["--reason", "all anew"]));
    assert_ne!(flip("velocity_gather:fine"), before);
    assert_eq!(baseline(&bench)["reasons"], serde_json::json!(["all anew"]));
}

#[test]
fn accept_refuses_bad_requests_and_incomparable_runs() {
    let bench = set_up();
    let before = fs::read(bench.path("base.json")).unwrap();
    let in_ci = |more: &[&str]| {
        let words = [&["limits", "accept", "--out", "out", "--reason", "r"], more].concat();
        bench.command(&words).env("CI", "true").output().unwrap()
    };
    assert_refused(&in_ci(&[]), 2, &["CI is set", "--force"]);
    let rows: &[(&[&str], &[&str])] = &[
        (&["--reason", " "], &["--reason: needs one line"]),
        (
            &["--reason", "r", "--only", "fan/*"],
            &["fan/* matches no case", "plate/velocity_gather:fine"],
        ),
        (&["--reason", "r", "--only", "["], &["--only"]),
        (&[], &["--reason"]),
    ];
    for (more, parts) in rows {
        assert_refused(&accept(&bench, more), 2, parts);
    }
    assert_eq!(fs::read(bench.path("base.json")).unwrap(), before);
    // A new truth for one case of a scene would leave the other cases with the old truth.
    assert_done(&bench.run(&FINE));
    assert_refused(
        &accept(&bench, &["--reason", "r", "--only", "plate/*"]),
        2,
        &["the truth is another", "accept the whole run"],
    );
    // Pretends that a graphics card made it.
    let text = String::from_utf8(before).unwrap();
    let kind = bench.read_run().adapter.unwrap().kind;
    let other = text.replace(&format!("\"kind\": \"{kind}\""), "\"kind\": \"quantum\"");
    assert_ne!(other, text);
    fs::write(bench.path("base.json"), other).unwrap();
    assert_refused(
        &accept(&bench, &["--reason", "r"]),
        2,
        &["another class", "quantum", "force it"],
    );
    assert_done(&in_ci(&["--force"]));
    assert!(
        !fs::read_to_string(bench.path("base.json"))
            .unwrap()
            .contains("quantum")
    );
}

#[test]
fn a_case_with_another_truth_is_not_compared() {
    let bench = set_up();
    let output = check(&bench, &["--seed", "9"]);
    assert_refused(
        &output,
        2,
        &[
            "base.json: its truth of plate (trailing) is another",
            "shuttertruth limits accept",
        ],
    );
    let output = bench.check(&[&["--filters", "identity", "--no-cache"], &BASELINE[..]].concat());
    assert_refused(
        &output,
        2,
        &[
            "has no scores of identity:default on plate",
            "shuttertruth limits accept",
        ],
    );
    fs::remove_file(bench.path("scenes/bounds.toml")).unwrap();
    assert_refused(&check(&bench, &[]), 2, &["[margin]"]);
    fs::write(bench.path("base.json"), "{}").unwrap();
    let output = check(&bench, &[]);
    assert_refused(&output, 2, &["base.json: no baseline"]);
    assert!(!stderr(&output).contains("panicked"));
}
