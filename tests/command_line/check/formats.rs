//! Reports for machines: JUnit, GitHub, JSON.

use std::fs;
use std::process::Output;

use super::{IDENTITY, assert_ends, bound, json, make_bounded};
use crate::sandbox::{Sandbox, files_below, quick_command};

#[test]
fn junit_has_a_case_for_every_bound() {
    let sandbox = Sandbox::new();
    sandbox.write(
        "bounds.toml",
        "[default]
flip_moving = { limit = 0.2, why = \"it serves a test\" }
label_tv = { limit = 0.9, why = \"it serves a test\" }
misplacement = { limit = 1.0, why = \"it serves a test\", level = \"report\" }
occluder_contamination = { limit = 0.5, why = \"it serves a test\" }
",
    );
    assert_ends(
        &sandbox.check(&[&IDENTITY[..], &["--junit", "x/junit.xml"]].concat()),
        1,
        &[],
    );
    let text = fs::read_to_string(sandbox.path("x/junit.xml")).unwrap();
    let report = quick_junit::Report::deserialize_from_str(&text).unwrap();
    let suite = &report.test_suites[0];
    assert_eq!(
        (report.test_suites.len(), suite.name.as_str()),
        (1, "plate")
    );
    let cases: Vec<_> = (suite.test_cases.iter())
        .map(|case| {
            let status = match &case.status {
                quick_junit::TestCaseStatus::Success { .. } => "kept",
                quick_junit::TestCaseStatus::NonSuccess { .. } => "broken",
                quick_junit::TestCaseStatus::Skipped { .. } => "skipped",
            };
            (case.name.as_str(), status)
        })
        .collect();
    let expected = [
        ("identity:default flip_moving", "broken"),
        ("identity:default label_tv", "kept"),
        ("identity:default misplacement", "skipped"),
        ("identity:default occluder_contamination", "skipped"),
    ];
    assert_eq!(cases, expected, "{text}");
    assert!(text.contains("most like no_blur"), "{text}");
}

#[test]
fn github_gets_at_most_ten_annotations_and_a_full_summary() {
    let sandbox = Sandbox::new();
    let metrics = [
        "flip_moving",
        "flip_hdr_moving",
        "flip_p95_moving",
        "label_tv",
        "misplacement",
        "deficit",
    ];
    let lines = metrics.map(|metric| {
        let limit = if metric == "misplacement" { 0.9 } else { 0.1 };
        format!("{metric} = {{ limit = {limit}, why = \"100 %: a|b\" }}\n")
    });
    sandbox.write("bounds.toml", &format!("[default]\n{}", lines.concat()));
    fs::write(sandbox.path("summary.md"), "before\n").unwrap();
    let check = |filters: &str| {
        let more = ["--github", "--filters", filters];
        let mut command = sandbox.command(&[&quick_command("check", "64")[..], &more].concat());
        command
            .env("GITHUB_STEP_SUMMARY", sandbox.path("summary.md"))
            .output()
            .unwrap()
    };
    let annotations = |output: &Output| -> Vec<String> {
        let text = assert_ends(output, 1, &[]);
        let lines = text.lines().filter(|line| line.starts_with("::"));
        lines.map(str::to_owned).collect()
    };
    let few = annotations(&check("identity"));
    assert_eq!(few.len(), 6, "{few:#?}");
    assert!(
        few[0].starts_with("::error title=plate / identity%3Adefault::BROKEN deficit 0."),
        "{}",
        few[0]
    );
    assert!(few[0].contains("95 %25 CI"), "{}", few[0]);
    let many = annotations(&check("identity,velocity_gather:fine"));
    assert_eq!(many.len(), 10, "{many:#?}");
    assert!(
        many[9].ends_with("::and 3 more: see the summary"),
        "{}",
        many[9]
    );
    let summary = fs::read_to_string(sandbox.path("summary.md")).unwrap();
    assert!(
        summary.starts_with("before\n## Shuttertruth: FAIL\n"),
        "{summary}"
    );
    let rows = summary.lines().filter(|line| line.starts_with("| plate |"));
    assert_eq!(rows.count(), 6 + 12, "{summary}");
}

#[test]
fn json_holds_the_same_verdict() {
    let sandbox = make_bounded(0.2, "required");
    let found = json(&sandbox, &[]);
    assert_eq!(found["format"], judge::CHECK_FORMAT);
    assert_eq!(found["decision"], "broken");
    let finding = &found["findings"][0];
    for (key, value) in [
        ("kind", "broken"),
        ("level", "required"),
        ("scene", "plate"),
        ("filter", "identity:default"),
        ("metric", "flip_moving"),
        ("why", "it serves a test"),
        ("place", "scenes/plate/bounds.toml:2"),
    ] {
        assert_eq!(finding[key], value);
    }
    assert_eq!(finding["worst"]["map"], "flip");
    assert_eq!(finding["resembles"]["decoy"], "no_blur");
}

/// The identity leaves a silhouette as short as the object: far below the ideal of 1.
#[test]
fn a_limit_on_a_distance_stands_beside_a_distance() {
    let sandbox = make_bounded(0.2, "required");
    sandbox.write("bounds.toml", &bound("extent", 0.01, "required"));
    let files = ["--junit", "junit.xml", "--github", "--filters", "identity"];
    let mut command = sandbox.command(&[&quick_command("check", "64")[..], &files].concat());
    command.env("GITHUB_STEP_SUMMARY", sandbox.path("summary.md"));
    let text = assert_ends(&command.output().unwrap(), 1, &["BROKEN extent"]);
    let finding = &sandbox.read_findings()[0];
    let interval = finding.interval.unwrap();
    let apart = (1.0 - interval.center).abs();
    assert!(apart > 0.01 && interval.high < 1.0, "{finding:?}");
    let ends = [1.0 - interval.high, 1.0 - interval.low].map(judge::number);
    let line = format!(
        "BROKEN extent {} from 1 (95 % CI {} to {})",
        judge::number(apart),
        ends[0],
        ends[1]
    );
    let limit = "; limit 0.01000, floor ";
    let annotation = text.lines().find(|line| line.starts_with("::error"));
    let junit = fs::read_to_string(sandbox.path("junit.xml")).unwrap();
    let one_line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    for (name, found) in [
        ("terminal", one_line.as_str()),
        ("annotation", &annotation.unwrap().replace("%25", "%")),
        ("JUnit", &junit),
    ] {
        assert!(
            found.contains(&line) && found.contains(limit),
            "{name}: {line}\n{found}"
        );
    }
    // Tables have the score itself, and say what its limit is on.
    let summary = fs::read_to_string(sandbox.path("summary.md")).unwrap();
    assert!(summary.contains("| 0.01000 from 1 |"), "{summary}");
    let pages = files_below(&sandbox.path("out"));
    let pages = pages
        .iter()
        .filter(|path| path.extension().is_some_and(|end| end == "html"));
    let pages: String = pages
        .map(|page| fs::read_to_string(page).unwrap())
        .collect();
    assert!(pages.contains("0.01000 from 1"), "no page says it");
}
