//! Limits on scores of sequences.

use judge::Outcome;
use measure::Run;
use metrics::{Metric, SequenceMetric};
use tests::text::assert_contains;

use super::{assert_ends, assert_limits, calibrate, check, json};
use crate::sandbox::{Sandbox, assert_refused, split};

/// Makes a sandbox whose plate has limits on a single frame and on sequences of three frames. The
/// identity's flicker is some hundredths of display white, squared.
fn bounded_sequence() -> Sandbox {
    let sandbox = Sandbox::checked();
    sandbox.write("bounds.toml", include_str!("sequences.toml"));
    sandbox
}

#[test]
fn a_check_judges_the_sequence_and_the_first_frame_as_without_it() {
    let sandbox = bounded_sequence();
    let parts = [
        "3 required bounds: 1 met, 2 not judged",
        "1 target: 1 not judged",
        "not judged: limits on sequences of 3 frames, 3 frames at 60 per second; \
         measure with --frames 3, --frames 3 --fps 60",
        "PASS",
    ];
    check(&sandbox, "", 0, &parts);
    let findings = sandbox.read_findings();
    let outcomes = findings
        .iter()
        .map(|finding| (finding.metric.name(), finding.outcome));
    let due = [
        ("flip_moving", Outcome::Kept),
        ("flicker", Outcome::NotJudged),
        ("jod", Outcome::NotJudged),
        ("popping", Outcome::NotJudged),
    ];
    let due = due.map(|(name, outcome)| (name.to_owned(), outcome));
    assert_eq!(outcomes.collect::<Vec<_>>(), due);
    let text = |run: &Run| serde_json::to_string(&run.cases).unwrap();
    let alone = text(&sandbox.read_run());

    // With frames, the first one is judged as without them.
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
    let printed = check(&sandbox, "--frames 3 --junit junit.xml", 1, &broken);
    assert!(!printed.contains("not judged"), "{printed}");
    assert_eq!(text(&sandbox.read_run()), alone, "bit for bit");
    assert_eq!(sandbox.read_findings()[0], findings[0]);
    let worst = assert_flicker(&sandbox);

    let read = |name: &str| sandbox.text(name);
    let limit = "BROKEN flicker over 3 frames";
    let frame = format!("; worst in frame {worst}");
    assert_contains(
        &read("junit.xml"),
        &["identity:default flicker", limit, &frame],
    );
    assert_contains(&read("out/report.html"), &[limit, "sequences.html"]);
    let json = &json(&sandbox, "--filters identity --frames 3")["findings"];
    assert_eq!(json[1]["kind"], "broken");
    assert_eq!(json[1]["frames"], 3);
    assert_eq!(json[2]["fps"], 60.0);

    // The finished run is judged again, without an adapter; limits that it cannot judge are
    // refused.
    let judge = |line: &str| sandbox.without_adapter(&split(line));
    assert_ends(&judge("check --run out"), 1, &[limit]);
    let parts = ["--frames", "cannot be used with", "RUN"];
    assert_refused(&judge("check --run out --frames 3"), 2, &parts);
    let other = sandbox.check(&split("--filters identity --frames 2"));
    let parts = [
        "bounds.toml:4: the limit on flicker holds for sequences of 3 frames, \
         and they are to have 2 frames",
        "shuttertruth limits calibrate",
    ];
    assert_refused(&other, 2, &parts);
}

/// Checks the finding about flicker against the measurement; returns the worst frame.
fn assert_flicker(sandbox: &Sandbox) -> u32 {
    let flicker = sandbox.read_findings().remove(1);
    assert_eq!(flicker.outcome, Outcome::Broken);
    assert_eq!(flicker.frames, Some(3));
    let run = sandbox.read_run();
    let sequence = run
        .sequences
        .iter()
        .find(|sequence| !sequence.is_reference)
        .unwrap();
    let metric = Metric::Sequence(SequenceMetric::Flicker);
    let interval = sequence.intervals[&metric];
    assert_eq!(flicker.interval, Some(interval));
    let value = flicker.value.unwrap();
    assert!(interval.low < value && value < interval.high);
    let worst = sequence.worst_frames[&metric];
    assert_eq!(flicker.worst_frame, Some(worst));
    assert_eq!(flicker.pictures, sequence.frames[worst as usize].folder);
    let pictures = sandbox.path("out").join(&flicker.pictures);
    assert!(pictures.join("change.png").is_file());
    worst
}

/// Proposes limits of a sequence of two frames.
fn calibrate_sequence(sandbox: &Sandbox) -> String {
    let (_, proposed) = calibrate(sandbox, "--frames 2 --jitter-frames 0");
    // Nothing is bounded yet: all eight scores of sequences, and four of single frames.
    assert_eq!(proposed.matches(", frames = 2, ").count(), 8, "{proposed}");
    assert_contains(&proposed, &[", frames = 2, fps = 60.0, size = [64, 32]"]);
    proposed
}

#[test]
fn limits_of_sequences_are_proposed_with_their_frames_and_rate() {
    calibrate_sequence(&Sandbox::new());
}

#[test]
#[ignore = "prove: limits of sequences; each test run checks those of a single frame"]
fn calibrated_limits_of_sequences_pass_the_filter_and_fail_a_worse_one() {
    let sandbox = Sandbox::new();
    let proposed = calibrate_sequence(&sandbox);
    // The dirt of two small frames is mostly noise of the truth, and its intervals differ from seed
    // to seed.
    let mut lines: Vec<&str> = proposed.lines().collect();
    lines.retain(|line| !line.starts_with("fixed_pattern"));
    sandbox.write("bounds.toml", &lines.join("\n"));
    let met = "11 required bounds: 11 met";
    assert_limits(&sandbox, "--frames 2", met, "BROKEN error over 2 frames");
}
