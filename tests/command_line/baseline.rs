//! Baselines: accepted scores, and later scores held against them.

use std::fs;
use std::process::Output;

use crate::sandbox::{Sandbox, assert_done, assert_refused, stderr, stdout};

const FINE: [&str; 2] = ["--filters", "velocity_gather:fine"];
const COARSER: [&str; 2] = ["--set", "velocity_gather.samples=2"];
const BASELINE: [&str; 2] = ["--baseline", "base.json"];

/// Makes a sandbox with a margin, measures the fine gather and accepts it.
fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    fs::write(
        sandbox.path("scenes/bounds.toml"),
        "[margin]\nflip_moving = 0.005\n",
    )
    .unwrap();
    assert_done(&run(&sandbox, &FINE));
    assert_done(&accept(&sandbox, &["--reason", "the first"]));
    sandbox
}

/// Runs `run` with the samples of a check.
fn run(sandbox: &Sandbox, more: &[&str]) -> Output {
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
    sandbox.shuttertruth(&[&words[..], size, more].concat())
}

fn accept(sandbox: &Sandbox, more: &[&str]) -> Output {
    let mut command = sandbox.command(&[&["limits", "accept", "--out", "out"], more].concat());
    command.env_remove("CI").output().unwrap()
}

fn check(sandbox: &Sandbox, more: &[&str]) -> Output {
    sandbox.check(&[&FINE[..], &BASELINE, more].concat())
}

fn baseline(sandbox: &Sandbox) -> serde_json::Value {
    sandbox.read_json("base.json")
}

#[test]
fn equal_scores_pass_and_worse_scores_are_reported() {
    let sandbox = set_up();
    let same = check(&sandbox, &[]);
    assert_done(&same);
    assert!(
        stdout(&same).contains("no worse: velocity_gather:fine flip_moving"),
        "{}",
        stdout(&same)
    );
    let worse = check(&sandbox, &COARSER);
    assert_eq!(worse.status.code(), Some(1), "{}", stdout(&worse));
    assert!(
        stdout(&worse).contains("WORSE: velocity_gather:fine samples=2 flip_moving, worse by 0.0"),
        "{}",
        stdout(&worse)
    );
    let margin = "[margin]\nflip_moving = 0.5\n";
    fs::write(sandbox.path("scenes/bounds.toml"), margin).unwrap();
    assert_done(&check(&sandbox, &COARSER));
}

#[test]
fn a_baseline_has_one_number_per_line_under_sorted_keys() {
    let sandbox = set_up();
    let text = fs::read_to_string(sandbox.path("base.json")).unwrap();
    let numbers: Vec<&str> = (text.lines().map(str::trim))
        .filter(|line| line.starts_with('"') && line.contains("\": ") && !line.ends_with('{'))
        .skip_while(|line| !line.starts_with("\"bleed"))
        .collect();
    assert!(numbers.len() > 20, "{text}");
    assert!(numbers.is_sorted(), "{numbers:#?}");
    let found = baseline(&sandbox);
    assert_eq!(found["reasons"][0], "the first");
    let run = sandbox.read_run();
    assert_eq!(found["adapter"]["name"], run.adapter.unwrap().name);
    assert_eq!(
        found["truths"]["plate"]["trailing"],
        run.cases[0].truth_hash
    );
    let before = text;
    assert_done(&accept(&sandbox, &["--reason", "the first"]));
    assert_eq!(
        fs::read_to_string(sandbox.path("base.json")).unwrap(),
        before
    );
}

#[test]
fn accept_names_its_run_and_newer_runs_of_other_sizes() {
    let sandbox = set_up();
    let first = accept(&sandbox, &["--reason", "again"]);
    let written = "written: base.json, from out/run.json (1 case at 64x32)\n";
    assert_eq!(
        (stdout(&first), stderr(&first)),
        (written.into(), "".into())
    );
    assert_done(&run(
        &sandbox,
        &["--size", "48x24", "--filters", "identity"],
    ));
    let beside = accept(&sandbox, &["--reason", "again"]);
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
    let other = sandbox.outside_ci(&words);
    let written = "written: base.json, from out/48x24/run.json (1 case at 48x24)\n";
    assert_eq!(
        (stdout(&other), stderr(&other)),
        (written.into(), "".into())
    );
    // A run that is not newer is no news.
    assert_done(&run(&sandbox, &FINE));
    assert_eq!(stderr(&accept(&sandbox, &["--reason", "again"])), "");
}

#[test]
fn accept_changes_only_the_named_cases() {
    let sandbox = set_up();
    let flip = |filter: &str| baseline(&sandbox)["scores"]["plate"][filter]["flip_moving"].clone();
    let before = flip("velocity_gather:fine");
    let both = ["--filters", "velocity_gather:fine,identity"];
    assert_done(&run(&sandbox, &[&both[..], &COARSER].concat()));
    let words = ["--only", "plate/ident*", "--reason", "one more"];
    assert_done(&accept(&sandbox, &words));
    assert_eq!(flip("velocity_gather:fine"), before);
    assert!(flip("identity:default").is_number());
    assert_eq!(
        baseline(&sandbox)["reasons"],
        serde_json::json!(["the first", "one more"])
    );
    assert_done(&accept(&sandbox, &["--reason", "all anew"]));
    assert_ne!(flip("velocity_gather:fine"), before);
    assert_eq!(
        baseline(&sandbox)["reasons"],
        serde_json::json!(["all anew"])
    );
}

#[test]
fn accept_refuses_bad_requests_and_incomparable_runs() {
    let sandbox = set_up();
    let before = fs::read(sandbox.path("base.json")).unwrap();
    let in_ci = |more: &[&str]| {
        let words = [&["limits", "accept", "--out", "out", "--reason", "r"], more].concat();
        sandbox.command(&words).env("CI", "true").output().unwrap()
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
        assert_refused(&accept(&sandbox, more), 2, parts);
    }
    assert_eq!(fs::read(sandbox.path("base.json")).unwrap(), before);
    // A new truth for one case of a scene would leave the other cases with the old truth.
    assert_done(&sandbox.run(&FINE));
    assert_refused(
        &accept(&sandbox, &["--reason", "r", "--only", "plate/*"]),
        2,
        &["the truth is another", "accept the whole run"],
    );
    // Pretends that a graphics card made it.
    let text = String::from_utf8(before).unwrap();
    let kind = sandbox.read_run().adapter.unwrap().kind;
    let other = text.replace(&format!("\"kind\": \"{kind}\""), "\"kind\": \"quantum\"");
    assert_ne!(other, text);
    fs::write(sandbox.path("base.json"), other).unwrap();
    assert_refused(
        &accept(&sandbox, &["--reason", "r"]),
        2,
        &["another class", "quantum", "force it"],
    );
    assert_done(&in_ci(&["--force"]));
    assert!(
        !fs::read_to_string(sandbox.path("base.json"))
            .unwrap()
            .contains("quantum")
    );
}

#[test]
fn a_case_with_another_truth_is_not_compared() {
    let sandbox = set_up();
    let output = check(&sandbox, &["--seed", "9"]);
    assert_refused(
        &output,
        2,
        &[
            "base.json: its truth of plate (trailing) is another",
            "shuttertruth limits accept",
        ],
    );
    let output = sandbox.check(&[&["--filters", "identity", "--no-cache"], &BASELINE[..]].concat());
    assert_refused(
        &output,
        2,
        &[
            "has no scores of identity:default on plate",
            "shuttertruth limits accept",
        ],
    );
    fs::remove_file(sandbox.path("scenes/bounds.toml")).unwrap();
    assert_refused(&check(&sandbox, &[]), 2, &["[margin]"]);
    fs::write(sandbox.path("base.json"), "{}").unwrap();
    let output = check(&sandbox, &[]);
    assert_refused(&output, 2, &["base.json: no baseline"]);
    assert!(!stderr(&output).contains("panicked"));
}
