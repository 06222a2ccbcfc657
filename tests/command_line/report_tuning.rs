//! The page of a tuning.

use std::fs;

use suite::{Sensitivity, Tuning};

use crate::bench::{Bench, assert_done, assert_refused};

const TUNE: &str = "tune --quiet --filter jump_flood --from paper --vary samples=2..16,jitter,foreground_extent --objective flip,bleed \
                    --scenes plate,slow --size 64x32 --samples-per-pixel 16 --out tuned";

fn bench() -> Bench {
    let bench = Bench::new();
    bench.copy_scene("slow", |text| {
        text.replace("-1.6", "-0.8")
            .replace("\"translation\"", "\"camera\"")
    });
    bench.copy_scene("sealed", |text| text.replace("-1.6", "-1.2"));
    bench
}

fn tune(bench: &Bench, more: &[&str]) {
    let words: Vec<&str> = TUNE.split_whitespace().collect();
    assert_done(&bench.shuttertruth(&[&words[..], more].concat()));
}

fn page(bench: &Bench) -> String {
    assert_done(&bench.shuttertruth(&["report", "tuned", "--html", "page.html"]));
    fs::read_to_string(bench.path("page.html")).unwrap()
}

/// The part of a page behind a heading, up to the next one.
#[track_caller]
fn section<'a>(page: &'a str, heading: &str) -> &'a str {
    let start = format!("<h2>{heading}</h2>");
    let (_, rest) = page
        .split_once(&start)
        .unwrap_or_else(|| panic!("no section {heading}"));
    rest.split("<h2>").next().unwrap()
}

#[test]
fn a_tuning_is_shown_with_its_trials_its_choice_and_its_folds() {
    let bench = bench();
    tune(
        &bench,
        &[
            "--budget",
            "14",
            "--sealed",
            "sealed",
            "--sealed-size",
            "64x32",
            "--sealed-samples-per-pixel",
            "16",
        ],
    );
    let page = page(&bench);
    let tuning: Tuning =
        serde_json::from_slice(&fs::read(bench.path("tuned/tune.json")).unwrap()).unwrap();
    assert!(page.contains("from paper, 14 trials on 2 scenes"));
    let convergence = section(&page, "Convergence");
    assert_eq!(
        convergence.matches("<circle").count(),
        14,
        "one mark a trial"
    );
    let front = section(&page, "Trials that ran on every scene");
    for trial in &tuning.front {
        assert!(
            front.contains(&format!("<th scope=\"row\">{}", trial.trial)),
            "trial {}",
            trial.trial
        );
    }
    let folds = section(&page, "Cross-validation");
    assert_eq!(tuning.folds.len(), 2, "two families");
    for fold in &tuning.folds {
        assert!(
            folds.contains(&fold.family) && folds.contains(&format!("{:+.3}", fold.gap)),
            "{fold:?}"
        );
    }
    let sealed = section(&page, "Choice against start on sealed scenes");
    let [start, chosen] = &tuning.openings[0].paired.scenes["sealed"];
    for score in [start, chosen] {
        assert!(sealed.contains(&format!("<td>{:.4}</td>", score.flip)));
    }
    let values = section(&page, "Values");
    for (name, value) in &tuning.chosen.values {
        assert!(
            values.contains(name.as_str()) && values.contains(&format!("{value}")),
            "{name}"
        );
    }
    // One chart a parameter that was varied.
    assert_eq!(
        section(&page, "Error along each parameter")
            .matches("<svg")
            .count(),
        3
    );
    for (_, hash) in &tuning.journal.scenes {
        assert!(section(&page, "Provenance").contains(hash.as_str()));
    }
    assert!(
        !page.contains("http:") && !page.contains("https:"),
        "something is fetched"
    );
}

#[test]
fn a_study_of_sensitivity_is_shown_with_intervals_and_slices() {
    let bench = bench();
    let words: Vec<&str> = TUNE.split_whitespace().skip(1).collect();
    assert_done(&bench.shuttertruth(&[&["sensitivity", "--rows", "4"], &words[..]].concat()));
    let page = page(&bench);
    let found: Sensitivity =
        serde_json::from_slice(&fs::read(bench.path("tuned/sensitivity.json")).unwrap()).unwrap();
    let table = section(&page, "Which parameters can become constants");
    for (name, own) in &found.parameters {
        let total = own.indices.unwrap().total;
        assert!(
            table.contains(&format!("{:.3} to {:.3}", total.low, total.high)),
            "{name}"
        );
    }
    let slices = section(&page, "Error along each parameter");
    assert_eq!(slices.matches("<polyline").count(), found.parameters.len());
}

#[test]
fn a_tuning_under_way_has_a_page_and_a_folder_without_any_is_refused() {
    let bench = bench();
    tune(&bench, &["--budget", "3"]);
    fs::remove_file(bench.path("tuned/tune.json")).unwrap();
    let journal = bench.path("tuned/journal.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    // A fourth trial is being written.
    fs::write(&journal, format!("{text}{{\"trial\": 3, \"val")).unwrap();
    assert_eq!(
        section(&page(&bench), "Convergence")
            .matches("<circle")
            .count(),
        3
    );
    let words = ["report", "tuned", "--html", "page.html"];
    fs::write(&journal, format!("{text}{{\"trial\": 3}}\n")).unwrap();
    assert_refused(
        &bench.shuttertruth(&words),
        2,
        &["tuned/journal.jsonl:5", "not of this program"],
    );
    fs::remove_file(&journal).unwrap();
    assert_refused(
        &bench.shuttertruth(&words),
        2,
        &["tuned: holds neither a run.json nor"],
    );
    let layers = ["report", "tuned", "--exr", "layers"];
    assert_refused(
        &bench.shuttertruth(&layers),
        2,
        &["--exr", "keeps no pictures"],
    );
}

#[test]
fn what_a_filter_says_is_shown_and_not_run() {
    let bench = bench();
    tune(&bench, &["--budget", "3"]);
    let path = bench.path("tuned/tune.json");
    let mut tuning: Tuning = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    tuning
        .failed
        .insert(2, "<script>alert(1)</script>".to_owned());
    fs::write(&path, serde_json::to_string(&tuning).unwrap()).unwrap();
    let page = page(&bench);
    assert!(
        page.contains("&lt;script&gt;alert(1)"),
        "the reason is not shown"
    );
    assert!(!page.contains("<script>alert(1)"), "the reason is a script");
}
