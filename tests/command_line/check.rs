//! Bounds as a user meets them: every exit code of `check`, and every form of its report.

use std::fs;
use std::process::Output;

use crate::bench::{Bench, assert_done, assert_refused, quick, stderr, stdout};

const IDENTITY: [&str; 2] = ["--filters", "identity"];

/// A bench whose scene holds the identity to a limit on `flip_moving`, which it scores about 0.3 in.
fn bounded(limit: f64, level: &str) -> Bench {
    let bench = Bench::new();
    bench.write("bounds.toml", &bound("flip_moving", limit, level));
    bench
}

fn bound(metric: &str, limit: f64, level: &str) -> String {
    format!(
        "[default]\n{metric} = {{ limit = {limit:?}, why = \"it serves a test\", level = \"{level}\" }}\n"
    )
}

#[track_caller]
fn assert_ends(output: &Output, code: i32, parts: &[&str]) -> String {
    let text = stdout(output);
    assert_eq!(output.status.code(), Some(code), "{text}{}", stderr(output));
    // Lines break where the terminal ends.
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    for part in parts {
        let found = text.contains(part) || words.contains(part);
        assert!(found, "\"{part}\" is missing from:\n{text}");
    }
    text
}

/// The last lines of a check, on one line.
fn verdict(output: &Output) -> String {
    let text = stdout(output);
    let start = ["PASS", "FAIL", "UNDECIDED:"].map(|word| text.rfind(&format!("\n{word}")));
    let start = start
        .into_iter()
        .flatten()
        .max()
        .expect("a verdict ends the check");
    text[start..]
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
}

fn json(bench: &Bench, more: &[&str]) -> serde_json::Value {
    let output = bench.check(&[&IDENTITY[..], &["--json"], more].concat());
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn scores_that_keep_their_bounds_pass() {
    let bench = bounded(0.9, "required");
    let text = assert_ends(&bench.check(&IDENTITY), 0, &["1 required bound: 1 kept"]);
    assert!(
        !text.contains("plate /"),
        "what is kept is not listed: {text}"
    );
    let case = &bench.measured_filters()[0];
    let interval = case.intervals["flip_moving"];
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
fn a_broken_bound_is_exit_code_1_with_all_that_helps() {
    let bench = bounded(0.2, "required");
    let output = bench.check(&IDENTITY);
    let text = assert_ends(
        &output,
        1,
        &[
            "plate / identity:default",
            "BROKEN flip_moving 0.2",
            "95 % CI 0.2",
            "limit 0.2000, floor 0.0",
            "scenes/plate/bounds.toml:2: it serves a test",
            "worst at (24, 8): out/plate/identity_default/worst_flip_moving.png",
            "most like no_blur, 0 % off",
            "pictures: out/plate/identity_default",
            "1 required bound: 1 broken",
        ],
    );
    assert!(verdict(&output).contains("a required bound is broken"));
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    assert!(
        bench
            .path("out/plate/identity_default/worst_flip_moving.png")
            .is_file()
    );
}

#[test]
fn a_blur_that_is_like_no_wrong_one_is_said_to_be_like_none() {
    let bench = bounded(0.04, "required");
    // A box over whatever moves, with front and back swapped: wrong in a way of its own. Scaled to 64 pixels, its tiles would be
    // too small for any blur.
    let output = bench.check(&[
        "--filters",
        "mcguire:motion_blur_demo,mcguire:paper",
        "--as-written",
        "--json",
    ]);
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let [own, short] = [0, 1].map(|filter| &found["findings"][filter]);
    assert_eq!([&own["kind"], &short["kind"]], ["broken"; 2]);
    assert!(own["resembles"].is_null(), "{own}");
    // Its taps count less towards the ends, and at 3 px that is much of them.
    assert_eq!(short["resembles"]["decoy"], "half_length", "{short}");
}

#[test]
fn what_is_only_reported_fails_nothing() {
    let bench = Bench::new();
    let text = bound("flip_moving", 0.2, "report");
    let required = "label_tv = { limit = 0.9, why = \"it serves a test\" }\n";
    bench.write("bounds.toml", &(text + required));
    assert_ends(
        &bench.check(&[&IDENTITY[..], &["-v"]].concat()),
        0,
        &["target missed flip_moving", "1 required bound: 1 kept"],
    );
}

#[test]
fn a_limit_inside_the_interval_is_exit_code_4_and_says_what_would_settle_it() {
    let bench = bounded(0.9, "required");
    let found = json(&bench, &[]);
    let interval = &found["findings"][0]["interval"];
    let [low, high] = ["low", "high"].map(|end| interval[end].as_f64().unwrap());
    // A little more than a quarter of the half width from its middle: 16 times the samples halve it twice.
    let limit = 0.5 * (low + high) + 0.26 * 0.5 * (high - low);
    bench.write("bounds.toml", &bound("flip_moving", limit, "required"));
    let output = bench.check(&IDENTITY);
    assert_ends(
        &output,
        4,
        &[
            "UNDECIDED flip_moving",
            "--samples-per-pixel 1024 would settle it",
        ],
    );
    assert!(verdict(&output).contains("raise --samples-per-pixel"));
    let value = found["findings"][0]["value"].as_f64().unwrap();
    bench.write(
        "bounds.toml",
        &bound("flip_moving", value.min(limit), "report"),
    );
    let required = "label_tv = { limit = 0.9, why = \"it serves a test\" }\n";
    let text = fs::read_to_string(bench.path("scenes/plate/bounds.toml")).unwrap();
    bench.write("bounds.toml", &(text + required));
    assert_ends(
        &bench.check(&[&IDENTITY[..], &["-v"]].concat()),
        0,
        &["target undecided flip_moving"],
    );
}

#[test]
fn a_bound_within_three_floors_is_exit_code_2_and_names_the_strictest() {
    let bench = bounded(0.9, "required");
    let found = json(&bench, &[]);
    let floor = found["findings"][0]["floor"].as_f64().unwrap();
    let strictest = found["findings"][0]["strictest"].as_f64().unwrap();
    assert_eq!(strictest, 3.0 * floor);
    bench.write(
        "bounds.toml",
        &bound("flip_moving", 0.99 * strictest, "report"),
    );
    let required = "label_tv = { limit = 0.9, why = \"it serves a test\" }\n";
    let text = fs::read_to_string(bench.path("scenes/plate/bounds.toml")).unwrap();
    bench.write("bounds.toml", &(text + required));
    let output = bench.check(&IDENTITY);
    let allowed = format!("the noise floor of {floor:.5}");
    assert_ends(
        &output,
        2,
        &["TOO STRICT flip_moving", &allowed[..20], "at the strictest"],
    );
    assert!(verdict(&output).contains("stricter than three noise floors"));
}

#[test]
fn a_case_of_which_no_bound_applies_is_no_success() {
    let bench = bounded(0.9, "required");
    bench.write(
        "scene.toml",
        &crate::bench::SCENE.replace("[-1.6, 0, 0]", "[0, 0, 0]"),
    );
    let output = bench.check(&IDENTITY);
    assert_ends(&output, 2, &["1 not applicable"]);
    assert!(verdict(&output).contains("no bound that applies"));
}

#[test]
fn what_cannot_be_checked_is_refused_before_anything_is_rendered() {
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
            &["--replicates 2: 4 or more are needed"],
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
        let bench = Bench::new();
        bench.write("bounds.toml", bounds);
        assert_refused(&bench.check(&[&IDENTITY[..], *more].concat()), 2, parts);
        assert!(
            !bench.path("out").exists(),
            "{more:?} left something behind"
        );
    }
    let bench = bounded(0.9, "required");
    fs::create_dir(bench.path("scenes/plates")).unwrap();
    fs::write(bench.path("scenes/plates/bounds.toml"), "").unwrap();
    assert_refused(
        &bench.check(&IDENTITY),
        2,
        &["plates/bounds.toml: bounds of a scene that does not exist"],
    );
}

#[test]
fn no_adapter_is_exit_code_3() {
    let bench = bounded(0.9, "required");
    let output = bench
        .command(&["check", "--out", "out", "--filters", "identity"])
        .env("VK_DRIVER_FILES", "/no/driver.json")
        .env("VK_ICD_FILENAMES", "/no/driver.json")
        .output()
        .unwrap();
    assert_refused(&output, 3, &["mesa-vulkan-drivers"]);
}

#[test]
fn junit_has_a_case_for_every_bound() {
    let bench = Bench::new();
    bench.write(
        "bounds.toml",
        "[default]
flip_moving = { limit = 0.2, why = \"it serves a test\" }
label_tv = { limit = 0.9, why = \"it serves a test\" }
misplacement = { limit = 1.0, why = \"it serves a test\", level = \"report\" }
occluder_contamination = { limit = 0.5, why = \"it serves a test\" }
",
    );
    assert_ends(
        &bench.check(&[&IDENTITY[..], &["--junit", "x/junit.xml"]].concat()),
        1,
        &[],
    );
    let text = fs::read_to_string(bench.path("x/junit.xml")).unwrap();
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
fn github_gets_ten_annotations_at_most_and_a_summary_of_all() {
    let bench = Bench::new();
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
    bench.write("bounds.toml", &format!("[default]\n{}", lines.concat()));
    fs::write(bench.path("summary.md"), "before\n").unwrap();
    let check = |filters: &str| {
        let more = ["--github", "--filters", filters];
        let mut command = bench.command(&[&quick("check", "64")[..], &more].concat());
        command
            .env("GITHUB_STEP_SUMMARY", bench.path("summary.md"))
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
    let summary = fs::read_to_string(bench.path("summary.md")).unwrap();
    assert!(
        summary.starts_with("before\n## Shuttertruth: FAIL\n"),
        "{summary}"
    );
    let rows = summary.lines().filter(|line| line.starts_with("| plate |"));
    assert_eq!(rows.count(), 6 + 12, "{summary}");
}

#[test]
fn json_says_the_same_to_a_machine() {
    let bench = bounded(0.2, "required");
    let found = json(&bench, &[]);
    assert_eq!(found["format"], suite::CHECK_FORMAT);
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

#[test]
fn calibrated_limits_are_kept_and_nothing_much_worse_is() {
    let bench = bounded(0.9, "required");
    let words = [
        "calibrate",
        "--quiet",
        "--out",
        "calibrated",
        "--size",
        "64x32",
        "--samples-per-pixel",
        "64",
        "--runs",
        "2",
        "--filters",
        "velocity_gather:fine",
        "--metrics",
        "flip_moving,misplacement,bleed_leading,extent,psnr_moving",
    ];
    let output = bench.shuttertruth(&words);
    assert_done(&output);
    let proposed = fs::read_to_string(bench.path("calibrated/plate.bounds.toml")).unwrap();
    assert!(stdout(&output).contains(&proposed));
    assert_eq!(proposed.matches("limit = ").count(), 5, "{proposed}");
    bench.write("bounds.toml", &proposed);
    // Another seed than either run's.
    let fine = ["--filters", "velocity_gather:fine", "--seed", "9"];
    assert_ends(&bench.check(&fine), 0, &["5 required bounds: 5 kept"]);
    let worse = [&fine[..], &["--set", "velocity_gather.samples=2"]].concat();
    assert_ends(&bench.check(&worse), 1, &["BROKEN flip_moving"]);
}

#[test]
fn a_finished_run_is_judged_without_an_adapter() {
    let bench = bounded(0.2, "required");
    let made = assert_ends(&bench.check(&IDENTITY), 1, &["BROKEN flip_moving"]);
    let judge = |words: &[&str]| {
        let mut command = bench.command(&[&["check"], words].concat());
        command.env("VK_DRIVER_FILES", "/dev/null");
        command.env("VK_ICD_FILENAMES", "/dev/null");
        command.env_remove("CI").output().unwrap()
    };
    // The page was written with the run.
    let made = made.replace(
        made.lines()
            .find(|line| line.starts_with("report: "))
            .unwrap(),
        "",
    );
    assert_eq!(
        assert_ends(&judge(&["out/run.json", "--evidence"]), 1, &[]),
        made.replace("\n\n", "\n")
    );
    // Evidence takes a while, and is made only for who asks.
    let plain = assert_ends(&judge(&["out"]), 1, &["BROKEN flip_moving"]);
    assert!(!plain.contains("worst at"), "{plain}");

    bench.write("bounds.toml", &bound("flip_moving", 0.9, "required"));
    assert_ends(&judge(&["out"]), 0, &["1 required bound: 1 kept"]);
    assert_eq!(bench.findings()[0].limit, 0.9);

    let output = judge(&["out", "--scenes-dir", "elsewhere"]);
    assert_refused(
        &output,
        2,
        &["elsewhere/plate", "no such scene", "--scenes-dir"],
    );
    fs::remove_file(bench.path("scenes/plate/bounds.toml")).unwrap();
    assert_refused(
        &judge(&["out"]),
        2,
        &["out/run.json", "no score of it has a bound"],
    );
    let output = judge(&["out", "--size", "64x32"]);
    assert_refused(&output, 2, &["--size", "cannot be used with", "RUN"]);
}

#[test]
fn a_judgement_of_another_run_is_refused() {
    let bench = bounded(0.2, "required");
    bench.check(&IDENTITY);
    let run = bench.path("out/run.json");
    let text = fs::read_to_string(&run).unwrap();
    fs::write(&run, text.replace("\"seed\": 1,", "\"seed\": 2,")).unwrap();
    let output = bench.shuttertruth(&["report", "out", "--html", "page.html"]);
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
