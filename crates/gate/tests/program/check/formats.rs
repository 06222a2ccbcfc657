//! Reports for machines: JUnit and GitHub.

use std::fs;

use quick_junit::{Report, TestCaseStatus};
use tests::text::assert_contains;

use super::{assert_ends, bound, check, make_bounded};
use crate::sandbox::{Sandbox, files_below, quick_command};

#[test]
fn junit_has_a_case_for_every_bound() {
    let sandbox = make_bounded(0.9, "required");
    let bounds = [
        ("flip_moving", 0.2),
        ("label_tv", 0.9),
        ("occluder_contamination", 0.5),
    ]
    .map(|(metric, limit)| bound(metric, limit, "required").replace("[default]\n", ""));
    sandbox.write(
        "bounds.toml",
        &(bound("misplacement", 1.0, "report") + &bounds.concat()),
    );
    check(&sandbox, "--junit x/junit.xml", 1, &["FAIL"]);
    let text = sandbox.text("x/junit.xml");
    let report = Report::deserialize_from_str(&text).unwrap();
    assert_eq!(report.test_suites.len(), 1, "one scene: {text}");
    let suite = &report.test_suites[0];
    assert_eq!(suite.name.as_str(), "plate");
    let cases = suite.test_cases.iter().map(|case| {
        let status = match &case.status {
            TestCaseStatus::Success { .. } => "kept",
            TestCaseStatus::NonSuccess { .. } => "broken",
            TestCaseStatus::Skipped { .. } => "skipped",
        };
        format!("{} {status}\n", case.name.as_str()).replace("identity:default ", "")
    });
    let due =
        "flip_moving broken\nlabel_tv kept\nmisplacement skipped\noccluder_contamination skipped\n";
    assert_eq!(cases.collect::<String>(), due, "{text}");
    assert_contains(&text, &["most like no_blur"]);
    let broken = &suite.test_cases[0];
    let picture = broken.system_out.as_ref().unwrap().as_str();
    let picture = picture.strip_prefix("[[ATTACHMENT|").unwrap();
    let picture = picture.strip_suffix("]]").unwrap();
    assert_eq!(picture, "out/plate/identity_default/worst_flip_moving.png");
    assert!(sandbox.path(picture).is_file());
    assert!(suite.test_cases[1].system_out.is_none(), "{text}");
    // The only scene takes all of the time, which is short: its case is read back.
    assert!(suite.time.is_some() && report.time == suite.time, "{text}");
}

/// Checks filters with GitHub's reports; returns the lines of annotations.
fn annotations(sandbox: &Sandbox, filters: &str, part: &str) -> Vec<String> {
    let more = ["--github", "--junit", "junit.xml", "--filters", filters];
    let mut command = sandbox.command(&[&quick_command("check", "64")[..], &more].concat());
    command.env("GITHUB_STEP_SUMMARY", sandbox.path("summary.md"));
    let text = assert_ends(&command.output().unwrap(), 1, &[part]);
    let lines = text.lines().filter(|line| line.starts_with("::"));
    lines.map(str::to_owned).collect()
}

#[test]
fn github_gets_at_most_ten_annotations_and_a_full_summary() {
    let sandbox = make_bounded(0.9, "required");
    let metrics = "flip_moving flip_hdr_moving flip_p95_moving label_tv misplacement deficit";
    let bounds = metrics.split(' ').map(|metric| {
        let limit = if metric == "misplacement" { 0.9 } else { 0.1 };
        format!("{metric} = {{ limit = {limit}, why = \"100 %: a|b\" }}\n")
    });
    let bounds: String = bounds.collect();
    sandbox.write("bounds.toml", &format!("[default]\n{bounds}"));
    sandbox.put("summary.md", "before\n");
    let few = annotations(&sandbox, "identity", "::error");
    assert_eq!(few.len(), 6, "{few:#?}");
    // The bounds have their table in line 1.
    let lines = sandbox.text("scenes/plate/bounds.toml");
    let line = lines.lines().position(|line| line.starts_with("deficit"));
    let line = line.unwrap() + 1;
    let first = &format!(
        "::error file=scenes/plate/bounds.toml,line={line},title=plate / identity%3Adefault::BROKEN deficit 0."
    );
    assert!(few[0].starts_with(first), "{}", few[0]);
    assert_contains(&few[0], &["95 %25 CI"]);
    let many = annotations(&sandbox, "identity,velocity_gather:fine", "::error");
    assert_eq!(many.len(), 10, "{many:#?}");
    assert!(many[9].ends_with("::and 3 more: see the summary"));
    let summary = sandbox.text("summary.md");
    let head = "before\n## Shuttertruth: FAIL\n";
    assert!(summary.starts_with(head), "{summary}");
    let rows = summary.lines().filter(|line| line.starts_with("| plate |"));
    assert_eq!(rows.count(), 6 + 12, "{summary}");
}

/// The identity leaves a silhouette as short as the object: far below the ideal of 1.
#[test]
fn a_limit_on_a_distance_stands_beside_a_distance() {
    let sandbox = make_bounded(0.9, "required");
    sandbox.write("bounds.toml", &bound("extent", 0.01, "required"));
    let annotation = annotations(&sandbox, "identity", "BROKEN extent").remove(0);
    let finding = &sandbox.read_findings()[0];
    let interval = finding.interval.unwrap();
    let apart = (1.0 - interval.center).abs();
    assert!(apart > 0.01 && interval.high < 1.0, "{finding:?}");
    let ends = [apart, 1.0 - interval.high, 1.0 - interval.low].map(judge::number);
    let [apart, low, high] = ends;
    let line = format!("BROKEN extent {apart} from 1 (95 % CI {low} to {high})");
    let parts = [line.as_str(), "; limit 0.01000, floor "];
    check(&sandbox, "", 1, &parts);
    assert_contains(&annotation.replace("%25", "%"), &parts);
    let read = |name: &str| sandbox.text(name);
    assert_contains(&read("junit.xml"), &parts);
    // Tables have the score itself, and name what its limit applies to.
    assert_contains(&read("summary.md"), &["| 0.01000 from 1 |"]);
    let pages = files_below(&sandbox.path("out")).into_iter();
    let mut pages = pages.filter(|path| path.extension().is_some_and(|end| end == "html"));
    let says_it = |page| fs::read_to_string(page).unwrap().contains("0.01000 from 1");
    assert!(pages.any(says_it), "no page says it");
}
