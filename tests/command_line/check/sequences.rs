//! Limits on scores of sequences.

use std::fs;

use judge::Outcome;
use metrics::{Metric, SequenceMetric};
use suite::Run;

use super::{IDENTITY, assert_ends, json};
use crate::sandbox::{Sandbox, assert_done, assert_refused, split};

const THREE: [&str; 2] = ["--frames", "3"];

/// Makes a sandbox whose plate has limits on a single frame and on sequences of three frames. The identity's flicker is some hundredths
/// of display white, squared.
fn bounded_sequence() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write(
        "bounds.toml",
        "[default]
flip_moving = { limit = 0.9, why = \"it serves a test\" }
[filter.identity]
flicker = { limit = 0.0001, frames = 3, why = \"a hundredth of white\" }
popping = { limit = 0.9, frames = 3, why = \"it serves a test\" }
jod = { limit = 1.0, frames = 3, fps = 60, why = \"it serves a test\", level = \"report\" }
",
    );
    sandbox
}

#[test]
fn a_check_judges_the_sequence_and_the_first_frame_as_without_it() {
    let sandbox = bounded_sequence();
    let single = sandbox.check(&IDENTITY);
    let parts = [
        "3 required bounds: 1 met, 2 not judged",
        "1 target: 1 not judged",
        "not judged: limits on sequences of 3 frames, 3 frames at 60 per second; measure with --frames 3, --frames 3 --fps 60",
        "PASS",
    ];
    assert_ends(&single, 0, &parts);
    let not_judged = sandbox.read_findings();
    let outcomes = |findings: &[judge::Finding]| -> Vec<(String, Outcome)> {
        let pairs = findings.iter().map(|own| (own.metric.name(), own.outcome));
        pairs.collect()
    };
    let due = |names: [(&str, Outcome); 4]| names.map(|(name, own)| (name.to_owned(), own));
    assert_eq!(
        outcomes(&not_judged),
        due([
            ("flip_moving", Outcome::Kept),
            ("flicker", Outcome::NotJudged),
            ("jod", Outcome::NotJudged),
            ("popping", Outcome::NotJudged),
        ])
    );
    let text = |run: &Run| serde_json::to_string(&run.cases).unwrap();
    let alone = text(&sandbox.read_run());

    let more = [&THREE[..], &["--junit", "junit.xml"]].concat();
    let output = sandbox.check(&[&IDENTITY[..], &more].concat());
    let broken = [
        "plate / identity:default",
        "BROKEN flicker over 3 frames 0.0",
        "white^2 (95 % CI ",
        "; limit 0.0001000, floor ",
        "scenes/plate/bounds.toml:4: a hundredth of white",
        "worst in frame ",
        "3 required bounds: 2 met, 1 broken",
        "1 target: 1 met",
        "FAIL",
    ];
    let printed = assert_ends(&output, 1, &broken);
    assert!(!printed.contains("not judged"), "{printed}");
    let run = sandbox.read_run();
    assert_eq!(text(&run), alone, "bit for bit");
    let findings = sandbox.read_findings();
    assert_eq!(findings[0], not_judged[0]);
    let flicker = &findings[1];
    assert_eq!(
        (flicker.outcome, flicker.frames),
        (Outcome::Broken, Some(3))
    );
    let own = run.sequences.iter().find(|own| !own.is_reference).unwrap();
    let interval = own.intervals[&Metric::Sequence(SequenceMetric::Flicker)];
    assert_eq!(flicker.interval, Some(interval));
    assert!(interval.low < flicker.value.unwrap() && flicker.value.unwrap() < interval.high);
    let worst = own.worst_frames[&Metric::Sequence(SequenceMetric::Flicker)];
    assert_eq!(flicker.worst_frame, Some(worst));
    assert_eq!(flicker.pictures, own.frames[worst as usize].folder);
    assert!(
        sandbox
            .path("out")
            .join(&flicker.pictures)
            .join("change.png")
            .is_file()
    );

    let junit = fs::read_to_string(sandbox.path("junit.xml")).unwrap();
    for part in [
        "identity:default flicker",
        "BROKEN flicker over 3 frames",
        &format!("; worst in frame {worst}"),
    ] {
        assert!(junit.contains(part), "{part}: {junit}");
    }
    let page = fs::read_to_string(sandbox.path("out/report.html")).unwrap();
    for part in ["BROKEN flicker over 3 frames", "sequences.html"] {
        assert!(page.contains(part), "{part}");
    }
    let json = json(&sandbox, &THREE);
    assert_eq!(json["findings"][1]["kind"], "broken");
    assert_eq!(json["findings"][1]["frames"], 3);
    assert_eq!(json["findings"][2]["fps"], 60.0);

    // The finished run is judged again, without an adapter, and refuses what it cannot measure.
    let judge = |words: &[&str]| sandbox.without_adapter(&[&["check", "out"], words].concat());
    assert_ends(&judge(&[]), 1, &["BROKEN flicker over 3 frames"]);
    assert_refused(
        &judge(&THREE),
        2,
        &["--frames", "cannot be used with", "RUN"],
    );
    let other = sandbox.check(&[&IDENTITY[..], &["--frames", "2"]].concat());
    let parts = [
        "bounds.toml:4: the limit on flicker holds for sequences of 3 frames, and they are to have 2 frames",
        "shuttertruth limits calibrate",
    ];
    assert_refused(&other, 2, &parts);
}

#[test]
fn calibrated_limits_of_sequences_pass_the_filter_and_fail_a_worse_one() {
    let sandbox = Sandbox::new();
    let words = split(
        "limits calibrate --quiet --out calibrated --size 64x32 --samples-per-pixel 64 --runs 2 --filters \
         velocity_gather:fine --frames 2 --jitter-frames 0",
    );
    let refused = sandbox.shuttertruth(&[&words[..13], &["--metrics", "flicker"]].concat());
    assert_refused(
        &refused,
        2,
        &["--metrics: flicker is a score of a sequence", "--frames"],
    );
    assert_done(&sandbox.shuttertruth(&words));
    let proposed = fs::read_to_string(sandbox.path("calibrated/plate.bounds.toml")).unwrap();
    // Nothing is bounded yet: all eight scores of sequences, and four of single frames.
    assert_eq!(proposed.matches(", frames = 2, ").count(), 8, "{proposed}");
    assert!(
        proposed.contains(", frames = 2, fps = 60.0, size = [64, 32]"),
        "{proposed}"
    );
    // The dirt of two small frames is mostly noise of the truth, whose intervals differ from seed to seed.
    let lines = proposed
        .lines()
        .filter(|line| !line.starts_with("fixed_pattern"));
    sandbox.write("bounds.toml", &lines.collect::<Vec<_>>().join("\n"));
    // A seed that neither run has.
    let fine = [
        "--filters",
        "velocity_gather:fine",
        "--seed",
        "9",
        "--frames",
        "2",
    ];
    assert_ends(&sandbox.check(&fine), 0, &["11 required bounds: 11 met"]);
    let worse = [&fine[..], &["--set", "velocity_gather.samples=2"]].concat();
    assert_ends(&sandbox.check(&worse), 1, &["BROKEN error over 2 frames"]);
}
