//! The page of a tuning.

use std::fs;

use tests::text::assert_contains;
use tune::{Sensitivity, Tuning};

use super::results::studied;
use crate::sandbox::Sandbox;

const WORDS: &str = "--quiet --filter jump_flood --from paper \
    --vary samples=2..16,jitter,foreground_extent --objective flip,bleed --scenes plate,slow --size 64x32 --samples-per-pixel 16 --out tuned";
const REPORT: &str = "report tuned --html page.html";

/// Makes a sandbox with two scenes of different families and one to hold out.
fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.copy_scene("slow", |text| {
        text.replace("-1.6", "-0.8")
            .replace("\"translation\"", "\"camera\"")
    });
    sandbox.copy_scene("held_out", |text| text.replace("-1.6", "-1.2"));
    sandbox
}

/// Tunes on two scenes, with a third one held out at a given size; returns the output.
pub fn tune_at(sandbox: &Sandbox, size: &str) -> String {
    let held_out = "--held-out held_out --held-out-samples-per-pixel 16 --held-out-size";
    sandbox.done(&format!(
        "tune search {WORDS} --budget 14 {held_out} {size}"
    ))
}

/// Makes a sandbox with such a tuning in `tuned`.
pub fn tuned() -> Sandbox {
    Sandbox::once(|sandbox| {
        sandbox.write_files("", &set_up().read_files());
        tune_at(sandbox, "64x32");
    })
}

fn make_page(sandbox: &Sandbox) -> String {
    sandbox.done(REPORT);
    sandbox.text("page.html")
}

/// Finds the part of a page from a heading to the next one.
#[track_caller]
fn find_section<'a>(page: &'a str, heading: &str) -> &'a str {
    let start = format!("<h2>{heading}</h2>");
    let (_, rest) = page
        .split_once(&start)
        .unwrap_or_else(|| panic!("no section {heading}"));
    rest.split("<h2>").next().unwrap()
}

#[test]
fn the_page_of_a_tuning_shows_trials_choice_and_folds() {
    let sandbox = tuned();
    let page = make_page(&sandbox);
    let tuning: Tuning = sandbox.read_json("tuned/tune.json");
    assert_contains(&page, &["from paper, 14 trials on 2 scenes"]);
    let section = |heading: &str| find_section(&page, heading);
    let circles = section("Convergence").matches("<circle").count();
    assert_eq!(circles, 14, "one mark a trial");
    let front = section("Trials that ran on every scene");
    for trial in &tuning.front {
        let head = "<th scope=\"row\" data-label=\"trial\">";
        assert_contains(front, &[&format!("{head}{}", trial.trial)]);
    }
    assert_eq!(tuning.folds.len(), 2, "two families");
    for fold in &tuning.folds {
        let gap = format!("{:+.3}", fold.gap);
        assert_contains(section("Cross-validation"), &[&fold.family, &gap]);
    }
    for score in &tuning.held_out[0].paired.scenes["held_out"] {
        let cell = format!("<td>{:.4}</td>", score.flip);
        assert_contains(section("Choice against start on held-out scenes"), &[&cell]);
    }
    for (name, value) in &tuning.chosen.values {
        assert_contains(section("Values"), &[name, &value.to_string()]);
    }
    let charts = section("Error along each parameter").matches("<svg");
    assert_eq!(charts.count(), 3, "one chart per varied parameter");
    for (_, hash) in &tuning.journal.scenes {
        assert_contains(section("Provenance"), &[hash]);
    }
    for words in ["http:", "https:"] {
        assert!(!page.contains(words), "something is fetched");
    }
}

#[test]
fn the_page_of_a_sensitivity_study_shows_intervals_and_slices() {
    let sandbox = studied();
    let report = REPORT.replace("tuned", "out");
    sandbox.done(&report);
    let page = sandbox.text("page.html");
    let study: Sensitivity = sandbox.read_json("out/sensitivity.json");
    let table = find_section(&page, "Which parameters can become constants");
    for parameter in study.parameters.values() {
        let total = parameter.indices.total;
        assert_contains(table, &[&format!("{:.3} to {:.3}", total.low, total.high)]);
    }
    let slices = find_section(&page, "Error along each parameter");
    assert_eq!(slices.matches("<polyline").count(), study.parameters.len());
    // A study of a version without Sobol indices.
    let mut old: serde_json::Value = serde_json::to_value(&study).unwrap();
    for parameter in old["parameters"].as_object_mut().unwrap().values_mut() {
        parameter["indices"] = serde_json::Value::Null;
    }
    sandbox.put("out/sensitivity.json", old.to_string());
    let parts = [
        "out/sensitivity.json",
        "no Sobol indices",
        "`shuttertruth tune search`",
    ];
    sandbox.refuse(&report, &parts);
}

#[test]
fn an_unfinished_tuning_has_a_page_and_an_empty_folder_is_refused() {
    let sandbox = tuned();
    fs::remove_file(sandbox.path("tuned/tune.json")).unwrap();
    let journal = sandbox.path("tuned/journal.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    // A half-written line.
    fs::write(&journal, format!("{text}{{\"trial\": 14, \"val")).unwrap();
    let page = make_page(&sandbox);
    let convergence = find_section(&page, "Convergence");
    assert_eq!(convergence.matches("<circle").count(), 14);
    fs::write(&journal, format!("{text}{{\"trial\": 14}}\n")).unwrap();
    sandbox.refuse(REPORT, &["tuned/journal.jsonl:16", "is no trial"]);
    fs::remove_file(&journal).unwrap();
    sandbox.refuse(REPORT, &["tuned: holds neither a run.json nor"]);
    let layers = "report tuned --exr layers";
    sandbox.refuse(layers, &["--exr", "keeps no pictures"]);
}

#[test]
fn texts_of_a_filter_are_shown_as_text() {
    let sandbox = tuned();
    let mut tuning: Tuning = sandbox.read_json("tuned/tune.json");
    let reason = "<script>alert(1)</script>".to_owned();
    tuning.failed.insert(2, reason);
    let text = serde_json::to_string(&tuning).unwrap();
    sandbox.put("tuned/tune.json", text);
    let page = make_page(&sandbox);
    assert_contains(&page, &["&lt;script&gt;alert(1)"]);
    assert!(!page.contains("<script>alert(1)"), "the reason is a script");
}
