//! Exit codes of `check`, each with its text.

use std::fs;

use frame::{Frame, Truth, read_exr};
use metrics::Metric;
use tests::text::{assert_contains, squeeze};

use super::{KEPT, assert_ends, bound, check, json, make_bounded};
use crate::sandbox::{IDENTITY, SCENE, Sandbox, assert_refused, split, stderr};

#[test]
fn scores_within_their_bounds_pass() {
    let sandbox = make_bounded(0.9, "required");
    let text = check(&sandbox, "", 0, &["1 required bound: 1 met"]);
    // Kept bounds are not listed.
    assert!(!text.contains("plate /"), "{text}");
    assert!(text.ends_with("\nPASS\n"), "{text}");
    let case = &sandbox.read_filter_cases()[0];
    let interval = case.intervals[&Metric::FLIP];
    let value = case.scores.moving.flip.value().unwrap();
    assert!(interval.low < value && value < interval.high);
}

#[test]
fn a_broken_bound_gives_exit_code_1_and_its_evidence() {
    let sandbox = make_bounded(0.2, "required");
    let parts = ["BROKEN flip_moving 0.2", "FAIL: a required bound is broken"];
    check(&sandbox, "", 1, &parts);
    // The page says so first, and praises nothing.
    let page = sandbox.text("out/report.html");
    let due = "FAIL</strong>: a required bound is broken. 1 required bound: 1 broken";
    let none = "nothing but no blur was measured";
    let [fails, nothing] = [due, none].map(|text| page.find(text));
    assert!(fails.is_some() && fails < nothing, "{fails:?} {nothing:?}");
    let picture = "out/plate/identity_default/worst_flip_moving.png";
    assert!(sandbox.path(picture).is_file());
    // JSON has the same verdict.
    let verdict = json(&sandbox, "--filters identity");
    assert_eq!(verdict["format"], gate::CHECK_FORMAT);
    assert_eq!(verdict["decision"], "broken");
    let finding = &verdict["findings"][0];
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

#[test]
fn a_blur_unlike_every_decoy_is_reported_as_such() {
    let sandbox = make_bounded(0.04, "required");
    // A box over everything that moves, with front and back swapped: wrong in a way that no decoy
    // is. Scaled to 64 pixels, its tiles would be too small to blur anything.
    let filters = "--filters mcguire:motion_blur_demo,mcguire:paper --as-written";
    let verdict = json(&sandbox, filters);
    let [box_filter, short] = [0, 1].map(|filter| &verdict["findings"][filter]);
    assert_eq!([&box_filter["kind"], &short["kind"]], ["broken"; 2]);
    assert!(box_filter["resembles"].is_null(), "{box_filter}");
    // Taps count less towards the ends of the trail. At 3 px that is a large part of it.
    assert_eq!(short["resembles"]["decoy"], "half_length", "{short}");
}

/// Replaces the bounds by one of flip_moving as a target, and another that is met.
fn write_target(sandbox: &Sandbox, limit: f64) {
    let text = bound("flip_moving", limit, "report") + KEPT;
    sandbox.write("bounds.toml", &text);
}

#[test]
fn a_bound_of_level_report_fails_nothing() {
    let sandbox = make_bounded(0.9, "required");
    write_target(&sandbox, 0.2);
    let parts = ["target missed flip_moving", "1 required bound: 1 met"];
    check(&sandbox, "-v", 0, &parts);
}

#[test]
fn a_limit_inside_the_interval_gives_exit_code_4_and_the_samples_to_decide() {
    let sandbox = make_bounded(0.9, "required");
    let finding = &json(&sandbox, "--filters identity")["findings"][0];
    let [low, high] = ["low", "high"].map(|end| finding["interval"][end].as_f64().unwrap());
    // The limit is a little more than a quarter of the half width off the interval's middle. 16
    // times the samples halve the width twice.
    let limit = 0.5 * (low + high) + 0.26 * 0.5 * (high - low);
    sandbox.write("bounds.toml", &bound("flip_moving", limit, "required"));
    let parts = [
        "UNDECIDED flip_moving",
        "1024 samples per pixel would settle it",
        "what settles it is said above",
    ];
    check(&sandbox, "", 4, &parts);
    let value = finding["value"].as_f64().unwrap();
    write_target(&sandbox, value.min(limit));
    check(&sandbox, "-v", 0, &["target undecided flip_moving"]);
}

#[test]
fn an_undecided_bound_within_three_floors_gives_exit_code_2_and_the_strictest_bound() {
    let sandbox = make_bounded(0.9, "required");
    // The error of so little motion is hardly more than noise.
    sandbox.write("scene.toml", &SCENE.replace("-1.6", "-0.002"));
    let finding = &json(&sandbox, "--filters identity")["findings"][0];
    let [floor, strictest] = ["floor", "strictest"].map(|key| finding[key].as_f64().unwrap());
    assert_eq!(strictest, 3.0 * floor);
    let [low, high] = ["low", "high"].map(|end| finding["interval"][end].as_f64().unwrap());
    let middle = f64::midpoint(low, high);
    assert!(middle < strictest && high < strictest, "{finding}");
    sandbox.write("bounds.toml", &bound("flip_moving", middle, "required"));
    let allowed = format!("the noise floor of {floor:.5}");
    let within = "LIMIT WITHIN NOISE flip_moving";
    let words = ["at the strictest", "stricter than three noise floors"];
    check(&sandbox, "", 2, &[within, &allowed[..20]]);
    check(&sandbox, "", 2, &words);
    // A target fails nothing.
    write_target(&sandbox, middle);
    check(&sandbox, "-v", 0, &["target within noise flip_moving"]);
    // Limits outside the interval are decided for certain, and so is another bound that is broken.
    sandbox.write("bounds.toml", &bound("flip_moving", 0.5 * low, "required"));
    check(&sandbox, "", 1, &["BROKEN flip_moving"]);
    sandbox.write(
        "bounds.toml",
        &bound("flip_moving", 1.01 * high, "required"),
    );
    check(&sandbox, "", 0, &["1 required bound: 1 met"]);
    let label = bound("label_tv", 1e-9, "required").replace("[default]\n", "");
    let both = bound("flip_moving", middle, "required") + &label;
    sandbox.write("bounds.toml", &both);
    let parts = [within, "BROKEN label_tv", "a required bound is broken"];
    check(&sandbox, "", 1, &parts);
}

#[test]
fn a_case_without_an_applicable_bound_does_not_pass() {
    let sandbox = make_bounded(0.9, "required");
    sandbox.write("scene.toml", &SCENE.replace("[-1.6, 0, 0]", "[0, 0, 0]"));
    let parts = ["1 not applicable", "no bound that applies"];
    check(&sandbox, "", 2, &parts);
    let due = "UNDECIDED</strong>: a case has no bound that applies";
    assert_contains(&sandbox.text("out/report.html"), &[due]);
}

#[test]
fn check_refuses_bad_input_before_it_renders() {
    let right = "[default]\nflip_moving = { limit = 0.1, why = \"w\" }\n";
    let target = right.replace("\"w\"", "\"w\", level = \"report\"");
    let of_none = right.replace("[default]", "[filter.jumpflood]");
    let none = "plate / identity:default: has no bound";
    let no_filter = "bounds.toml:1: no filter is called \"jumpflood\"";
    let few = "found 2 replicates of the truth; confidence intervals need 4 or more";
    let rows: [(&str, &str, &[&str]); 6] = [
        ("", "", &[none, "[default]"]),
        (&target, "", &["no bound of identity:default is required"]),
        (&of_none, "", &[no_filter]),
        (right, "--replicates 2", &[few]),
        (right, "--github", &["GITHUB_STEP_SUMMARY is not set"]),
        (right, "--baseline base.json", &["base.json"]),
    ];
    let sandbox = Sandbox::new();
    let refuse = |more: &str, parts: &[&str]| {
        let words = [&IDENTITY[..], &split(more)].concat();
        assert_refused(&sandbox.check(&words), 2, parts);
        assert!(!sandbox.path("out").exists(), "{more} wrote files");
    };
    for (bounds, more, parts) in rows {
        sandbox.write("bounds.toml", bounds);
        refuse(more, parts);
    }
    fs::create_dir(sandbox.path("scenes/plates")).unwrap();
    sandbox.put("scenes/plates/bounds.toml", "");
    let message = "plates/bounds.toml: bounds of a scene that does not exist";
    refuse("", &[message]);
}

#[test]
fn an_error_map_that_no_file_holds_is_measured_again() {
    let sandbox = make_bounded(0.9, "required");
    sandbox.write("bounds.toml", &bound("mae_moving", 0.001, "required"));
    let verdict = json(&sandbox, "--filters identity");
    let map = &verdict["findings"][0]["worst"]["map"];
    assert_eq!(*map, "absolute_error", "{verdict}");
    let case = &sandbox.read_filter_cases()[0];
    let out = sandbox.path("out");
    let errors = read_exr(&out.join(&case.folder).join("errors.exr")).unwrap();
    assert!(errors.plane("absolute_error").is_err(), "it is not kept");
    let maps = measure::ErrorMaps::read(case, &out).unwrap();
    let map = maps.map("absolute_error").unwrap();
    let frame = Frame::read(&out.join("plate/frame.exr")).unwrap();
    let truth = Truth::read(&out.join("plate/truth_trailing.exr")).unwrap();
    let scale = frame.display.stops.exp2();
    // The identity's output is the frame.
    let expected = frame.color.zip(&truth.mean().color, |output, truth| {
        let sum: f32 = (0..3).map(|c| (output[c] - truth[c]).abs()).sum();
        sum * scale / 3.0
    });
    assert!(expected.pixels.iter().any(|error| *error > 0.05));
    for (error, expected) in map.pixels.iter().zip(&expected.pixels) {
        assert!((error - expected).abs() < 1e-6, "{error} {expected}");
    }
}

#[test]
fn a_finished_run_is_judged_without_an_adapter() {
    let sandbox = make_bounded(0.2, "required");
    let broken = ["BROKEN flip_moving"];
    let made = check(&sandbox, "", 1, &broken);
    let judge = |line: &str| sandbox.without_adapter(&split(&format!("check --run {line}")));
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
fn a_finished_run_that_cannot_be_written_to_is_judged_all_the_same() {
    for (limit, code) in [(0.2, 1), (0.9, 0)] {
        let sandbox = make_bounded(0.2, "required");
        check(&sandbox, "", 1, &["BROKEN flip_moving"]);
        sandbox.write("bounds.toml", &bound("flip_moving", limit, "required"));
        // Nobody writes a file where a folder is, not even root on a read-only disk.
        let place = sandbox.path("out/judgement.json");
        fs::remove_file(&place).unwrap();
        fs::create_dir(&place).unwrap();
        let output = sandbox.without_adapter(&split("check --run out/run.json"));
        assert_ends(&output, code, &["1 required bound: 1"]);
        assert_contains(
            &stderr(&output),
            &["note: out/judgement.json: cannot write"],
        );
    }
}

#[test]
fn a_judgement_of_another_run_is_refused() {
    let sandbox = make_bounded(0.2, "required");
    let run = sandbox.path("out/run.json");
    let text = fs::read_to_string(&run).unwrap();
    fs::write(&run, text.replace("\"seed\": 1,", "\"seed\": 2,")).unwrap();
    let parts = [
        "judgement.json",
        "about another run.json",
        "shuttertruth check --run out/run.json",
    ];
    sandbox.refuse("report out --html page.html", &parts);
}
