//! The page of a tuning.

use std::fs;

use tune::{Sensitivity, Tuning};

use crate::sandbox::{Sandbox, assert_refused, split};

const TUNE: &str = "tune search --quiet --filter jump_flood --from paper --vary samples=2..16,jitter,foreground_extent --objective flip,bleed \
                    --scenes plate,slow --size 64x32 --samples-per-pixel 16 --out tuned";

fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.copy_scene("slow", |text| {
        text.replace("-1.6", "-0.8")
            .replace("\"translation\"", "\"camera\"")
    });
    sandbox.copy_scene("held_out", |text| text.replace("-1.6", "-1.2"));
    sandbox
}

fn tune(sandbox: &Sandbox, more: &[&str]) {
    sandbox.execute(&[&split(TUNE)[..], more].concat());
}

fn make_page(sandbox: &Sandbox) -> String {
    sandbox.execute(&["report", "tuned", "--html", "page.html"]);
    fs::read_to_string(sandbox.path("page.html")).unwrap()
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
    let sandbox = set_up();
    tune(
        &sandbox,
        &split(
            "--budget 14 --held-out held_out --held-out-size 64x32 --held-out-samples-per-pixel 16",
        ),
    );
    let page = make_page(&sandbox);
    let tuning: Tuning = sandbox.read_json("tuned/tune.json");
    assert!(page.contains("from paper, 14 trials on 2 scenes"));
    let convergence = find_section(&page, "Convergence");
    assert_eq!(
        convergence.matches("<circle").count(),
        14,
        "one mark a trial"
    );
    let front = find_section(&page, "Trials that ran on every scene");
    for trial in &tuning.front {
        assert!(
            front.contains(&format!(
                "<th scope=\"row\" data-label=\"trial\">{}",
                trial.trial
            )),
            "trial {}",
            trial.trial
        );
    }
    let folds = find_section(&page, "Cross-validation");
    assert_eq!(tuning.folds.len(), 2, "two families");
    for fold in &tuning.folds {
        assert!(
            folds.contains(&fold.family) && folds.contains(&format!("{:+.3}", fold.gap)),
            "{fold:?}"
        );
    }
    let held_out = find_section(&page, "Choice against start on held-out scenes");
    let [start, chosen] = &tuning.held_out[0].paired.scenes["held_out"];
    for score in [start, chosen] {
        assert!(held_out.contains(&format!("<td>{:.4}</td>", score.flip)));
    }
    let values = find_section(&page, "Values");
    for (name, value) in &tuning.chosen.values {
        assert!(
            values.contains(name.as_str()) && values.contains(&format!("{value}")),
            "{name}"
        );
    }
    // One chart per varied parameter.
    assert_eq!(
        find_section(&page, "Error along each parameter")
            .matches("<svg")
            .count(),
        3
    );
    for (_, hash) in &tuning.journal.scenes {
        assert!(find_section(&page, "Provenance").contains(hash.as_str()));
    }
    assert!(
        !page.contains("http:") && !page.contains("https:"),
        "something is fetched"
    );
}

#[test]
fn the_page_of_a_sensitivity_study_shows_intervals_and_slices() {
    let sandbox = set_up();
    let words: Vec<&str> = TUNE.split_whitespace().skip(2).collect();
    sandbox.execute(&[&["tune", "sensitivity", "--rows", "4"], &words[..]].concat());
    let page = make_page(&sandbox);
    let found: Sensitivity =
        serde_json::from_slice(&fs::read(sandbox.path("tuned/sensitivity.json")).unwrap()).unwrap();
    let table = find_section(&page, "Which parameters can become constants");
    for (name, own) in &found.parameters {
        let total = own.indices.total;
        assert!(
            table.contains(&format!("{:.3} to {:.3}", total.low, total.high)),
            "{name}"
        );
    }
    let slices = find_section(&page, "Error along each parameter");
    assert_eq!(slices.matches("<polyline").count(), found.parameters.len());
    // A study of a version without Sobol indices.
    let mut old: serde_json::Value = serde_json::to_value(&found).unwrap();
    for own in old["parameters"].as_object_mut().unwrap().values_mut() {
        own["indices"] = serde_json::Value::Null;
    }
    fs::write(sandbox.path("tuned/sensitivity.json"), old.to_string()).unwrap();
    assert_refused(
        &sandbox.shuttertruth(&["report", "tuned", "--html", "page.html"]),
        2,
        &[
            "tuned/sensitivity.json",
            "no Sobol indices",
            "`shuttertruth tune search`",
        ],
    );
}

#[test]
fn an_unfinished_tuning_has_a_page_and_an_empty_folder_is_refused() {
    let sandbox = set_up();
    tune(&sandbox, &["--budget", "3"]);
    fs::remove_file(sandbox.path("tuned/tune.json")).unwrap();
    let journal = sandbox.path("tuned/journal.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    // A fourth trial is half written.
    fs::write(&journal, format!("{text}{{\"trial\": 3, \"val")).unwrap();
    assert_eq!(
        find_section(&make_page(&sandbox), "Convergence")
            .matches("<circle")
            .count(),
        3
    );
    let words = ["report", "tuned", "--html", "page.html"];
    fs::write(&journal, format!("{text}{{\"trial\": 3}}\n")).unwrap();
    assert_refused(
        &sandbox.shuttertruth(&words),
        2,
        &["tuned/journal.jsonl:5", "is no trial"],
    );
    fs::remove_file(&journal).unwrap();
    assert_refused(
        &sandbox.shuttertruth(&words),
        2,
        &["tuned: holds neither a run.json nor"],
    );
    let layers = ["report", "tuned", "--exr", "layers"];
    assert_refused(
        &sandbox.shuttertruth(&layers),
        2,
        &["--exr", "keeps no pictures"],
    );
}

#[test]
fn texts_of_a_filter_are_shown_as_text() {
    let sandbox = set_up();
    tune(&sandbox, &["--budget", "3"]);
    let path = sandbox.path("tuned/tune.json");
    let mut tuning: Tuning = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    tuning
        .failed
        .insert(2, "<script>alert(1)</script>".to_owned());
    fs::write(&path, serde_json::to_string(&tuning).unwrap()).unwrap();
    let page = make_page(&sandbox);
    assert!(
        page.contains("&lt;script&gt;alert(1)"),
        "the reason is not shown"
    );
    assert!(!page.contains("<script>alert(1)"), "the reason is a script");
}
