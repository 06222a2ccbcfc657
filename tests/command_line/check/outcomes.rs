//! Exit codes of `check`, each with its text.

use std::fs;

use frame::{Frame, Truth, read_exr};
use metrics::Metric;

use super::{IDENTITY, assert_ends, bound, json, make_bounded, verdict};
use crate::sandbox::{SCENE, Sandbox, assert_refused};

#[test]
fn scores_within_their_bounds_pass() {
    let sandbox = make_bounded(0.9, "required");
    let text = assert_ends(&sandbox.check(&IDENTITY), 0, &["1 required bound: 1 met"]);
    assert!(
        !text.contains("plate /"),
        "what is kept is not listed: {text}"
    );
    let case = &sandbox.read_filter_cases()[0];
    let interval = case.intervals[&Metric::FLIP];
    let value = case
        .scores
        .get("flip_moving".parse().unwrap())
        .value()
        .unwrap();
    assert!(
        interval.low < value && value < interval.high,
        "{interval:?} {value}"
    );
}

#[test]
fn a_broken_bound_gives_exit_code_1_and_its_evidence() {
    let sandbox = make_bounded(0.2, "required");
    let output = sandbox.check(&IDENTITY);
    assert_ends(&output, 1, &["BROKEN flip_moving 0.2"]);
    assert!(verdict(&output).contains("a required bound is broken"));
    assert!(
        sandbox
            .path("out/plate/identity_default/worst_flip_moving.png")
            .is_file()
    );
}

#[test]
fn a_blur_unlike_every_decoy_is_reported_as_such() {
    let sandbox = make_bounded(0.04, "required");
    // A box over whatever moves, with front and back swapped: wrong in a way that no decoy is. Scaled to 64 pixels, its
    // tiles would be too small to blur anything.
    let output = sandbox.check(&[
        "--filters",
        "mcguire:motion_blur_demo,mcguire:paper",
        "--as-written",
        "--json",
    ]);
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let [own, short] = [0, 1].map(|filter| &found["findings"][filter]);
    assert_eq!([&own["kind"], &short["kind"]], ["broken"; 2]);
    assert!(own["resembles"].is_null(), "{own}");
    // Taps count less towards the ends of the trail. At 3 px that is a large part of it.
    assert_eq!(short["resembles"]["decoy"], "half_length", "{short}");
}

#[test]
fn a_bound_of_level_report_fails_nothing() {
    let sandbox = Sandbox::new();
    let text = bound("flip_moving", 0.2, "report");
    let required = "label_tv = { limit = 0.9, why = \"it serves a test\" }\n";
    sandbox.write("bounds.toml", &(text + required));
    assert_ends(
        &sandbox.check(&[&IDENTITY[..], &["-v"]].concat()),
        0,
        &["target missed flip_moving", "1 required bound: 1 met"],
    );
}

#[test]
fn a_limit_inside_the_interval_gives_exit_code_4_and_the_samples_to_decide() {
    let sandbox = make_bounded(0.9, "required");
    let found = json(&sandbox, &[]);
    let interval = &found["findings"][0]["interval"];
    let [low, high] = ["low", "high"].map(|end| interval[end].as_f64().unwrap());
    // The limit lies a little more than a quarter of the interval's half width from its middle. 16 times the samples
    // halve the width twice.
    let limit = 0.5 * (low + high) + 0.26 * 0.5 * (high - low);
    sandbox.write("bounds.toml", &bound("flip_moving", limit, "required"));
    let output = sandbox.check(&IDENTITY);
    assert_ends(
        &output,
        4,
        &[
            "UNDECIDED flip_moving",
            "1024 samples per pixel would settle it",
        ],
    );
    assert!(verdict(&output).contains("raise the samples per pixel"));
    let value = found["findings"][0]["value"].as_f64().unwrap();
    sandbox.write(
        "bounds.toml",
        &bound("flip_moving", value.min(limit), "report"),
    );
    let required = "label_tv = { limit = 0.9, why = \"it serves a test\" }\n";
    let text = fs::read_to_string(sandbox.path("scenes/plate/bounds.toml")).unwrap();
    sandbox.write("bounds.toml", &(text + required));
    assert_ends(
        &sandbox.check(&[&IDENTITY[..], &["-v"]].concat()),
        0,
        &["target undecided flip_moving"],
    );
}

#[test]
fn a_bound_within_three_floors_gives_exit_code_2_and_the_strictest_bound() {
    let sandbox = make_bounded(0.9, "required");
    let found = json(&sandbox, &[]);
    let floor = found["findings"][0]["floor"].as_f64().unwrap();
    let strictest = found["findings"][0]["strictest"].as_f64().unwrap();
    assert_eq!(strictest, 3.0 * floor);
    sandbox.write(
        "bounds.toml",
        &bound("flip_moving", 0.99 * strictest, "report"),
    );
    let required = "label_tv = { limit = 0.9, why = \"it serves a test\" }\n";
    let text = fs::read_to_string(sandbox.path("scenes/plate/bounds.toml")).unwrap();
    sandbox.write("bounds.toml", &(text.clone() + required));
    let output = sandbox.check(&IDENTITY);
    let allowed = format!("the noise floor of {floor:.5}");
    assert_ends(
        &output,
        2,
        &[
            "LIMIT WITHIN NOISE flip_moving",
            &allowed[..20],
            "at the strictest",
        ],
    );
    assert!(verdict(&output).contains("stricter than three noise floors"));
    // A bound that is broken beside it is a fact.
    sandbox.write("bounds.toml", &(text + &required.replace("0.9", "0.02")));
    let output = sandbox.check(&IDENTITY);
    assert_ends(
        &output,
        1,
        &["LIMIT WITHIN NOISE flip_moving", "BROKEN label_tv"],
    );
    assert!(verdict(&output).contains("a required bound is broken"));
}

#[test]
fn a_case_without_an_applicable_bound_does_not_pass() {
    let sandbox = make_bounded(0.9, "required");
    sandbox.write("scene.toml", &SCENE.replace("[-1.6, 0, 0]", "[0, 0, 0]"));
    let output = sandbox.check(&IDENTITY);
    assert_ends(&output, 2, &["1 not applicable"]);
    assert!(verdict(&output).contains("no bound that applies"));
}

#[test]
fn check_refuses_bad_input_before_it_renders() {
    let rows: &[(&str, &[&str], &[&str])] = &[
        (
            "",
            &[],
            &["plate / identity:default: has no bound", "[default]"],
        ),
        (
            "[default]\nflip_moving = { limit = 0.1, why = \"w\", level = \"report\" }\n",
            &[],
            &["no bound of identity:default is required"],
        ),
        (
            "[default]\nflip = { limit = 0.1, why = \"w\" }\n",
            &[],
            &["bounds.toml:2: metric \"flip\" is unknown"],
        ),
        (
            "[filter.jumpflood]\nextent = { limit = 0.1, why = \"w\" }\n",
            &[],
            &["bounds.toml:1: no filter is called \"jumpflood\""],
        ),
        (
            "[default]\nflip_moving = { limit = 0.1, why = \"w\" }\n",
            &["--replicates", "2"],
            &["found 2 replicates of the truth; confidence intervals need 4 or more"],
        ),
        (
            "[default]\nflip_moving = { limit = 0.1, why = \"w\" }\n",
            &["--github"],
            &["GITHUB_STEP_SUMMARY is not set"],
        ),
        (
            "[default]\nflip_moving = { limit = 0.1, why = \"w\" }\n",
            &["--baseline", "base.json"],
            &["base.json"],
        ),
    ];
    for (bounds, more, parts) in rows {
        let sandbox = Sandbox::new();
        sandbox.write("bounds.toml", bounds);
        assert_refused(&sandbox.check(&[&IDENTITY[..], *more].concat()), 2, parts);
        assert!(
            !sandbox.path("out").exists(),
            "{more:?} left something behind"
        );
    }
    let sandbox = make_bounded(0.9, "required");
    fs::create_dir(sandbox.path("scenes/plates")).unwrap();
    fs::write(sandbox.path("scenes/plates/bounds.toml"), "").unwrap();
    assert_refused(
        &sandbox.check(&IDENTITY),
        2,
        &["plates/bounds.toml: bounds of a scene that does not exist"],
    );
}

#[test]
fn a_missing_adapter_gives_exit_code_3() {
    let sandbox = make_bounded(0.9, "required");
    let output = sandbox.without_adapter(&["check", "--out", "out", "--filters", "identity"]);
    assert_refused(&output, 3, &["mesa-vulkan-drivers"]);
}

#[test]
fn an_error_map_that_no_file_holds_is_measured_again() {
    let sandbox = Sandbox::new();
    sandbox.write("bounds.toml", &bound("mae_moving", 0.001, "required"));
    let output = sandbox.check(&[&IDENTITY[..], &["--json"]].concat());
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let worst = &found["findings"][0]["worst"];
    assert_eq!(worst["map"], "absolute_error", "{found}");
    let run = sandbox.read_run();
    let case = (run.cases.iter())
        .find(|case| case.filter == "identity")
        .unwrap();
    let out = sandbox.path("out");
    let errors = read_exr(&out.join(&case.folder).join("errors.exr")).unwrap();
    assert!(errors.plane("absolute_error").is_err(), "it is not kept");
    let map = (suite::ErrorMaps::read(case, &out).unwrap())
        .map("absolute_error")
        .unwrap();
    let frame = Frame::read(&out.join("plate/frame.exr")).unwrap();
    let truth = Truth::read(&out.join("plate/truth_trailing.exr")).unwrap();
    let scale = frame.display.stops.exp2();
    // The identity's output is the frame.
    let expected = frame.color.zip(&truth.mean().color, |output, truth| {
        let sum: f32 = (0..3).map(|c| (output[c] - truth[c]).abs()).sum();
        sum * scale / 3.0
    });
    assert!(expected.pixels.iter().any(|error| *error > 0.05));
    for (found, expected) in map.pixels.iter().zip(&expected.pixels) {
        assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    }
}
