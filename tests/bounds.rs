//! The shipped bounds tell a blur from none: on every shipped scene where something moves.

use std::path::Path;

use frame::{Alignment, Picture};
use metrics::{Metric, Reference};
use suite::{Outcome, RenderSettings, SceneChoice, Verdict};

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes");

/// Verdicts on the instant itself, and on the mean of 64 sub-frames.
fn verdicts(choice: &SceneChoice) -> [Vec<Verdict>; 2] {
    let out = tempfile::tempdir().unwrap();
    let settings = RenderSettings::default();
    let scene = &choice.scene;
    let frame = suite::frame_of(scene, &settings, out.path(), true).unwrap();
    let (truth, ladder) =
        suite::truth_and_ladder_of(scene, &settings, Alignment::Trailing, out.path(), true)
            .unwrap();
    let reference = Reference::new(&frame, &truth, None, &suite::viewing(scene)).unwrap();
    let bounds = suite::read_bounds(Path::new(SCENES), &choice.folder).unwrap();
    let judged =
        |picture: &Picture| suite::judge(&reference.measure(picture).unwrap().scores, &bounds);
    let identity = Picture {
        color: frame.color.clone(),
        coverage: frame.coverage.clone(),
    };
    let rung = ladder
        .rungs
        .iter()
        .find(|rung| rung.subframes == 64)
        .unwrap();
    [judged(&identity), judged(&Picture::mean(&rung.halves))]
}

fn describe(verdicts: &[Verdict]) -> String {
    let lines = verdicts.iter().map(|verdict| {
        let limit = verdict.limit;
        match &verdict.outcome {
            Outcome::Kept { value } => format!("  {} = {value:.4} keeps {limit}", verdict.metric),
            Outcome::Broken { value } => {
                format!("  {} = {value:.4} BREAKS {limit}", verdict.metric)
            }
            Outcome::TooNoisy { floor, strictest } => {
                format!(
                    "  {} <= {limit} is TOO STRICT for floor {floor:.4} ({strictest:.4})",
                    verdict.metric
                )
            }
            Outcome::NotApplicable { reason } => format!("  {}: {reason}", verdict.metric),
        }
    });
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn the_identity_breaks_a_bound_in_every_moving_scene_and_64_subframes_break_none() {
    let scenes = suite::select_scenes(Path::new(SCENES), &[]).unwrap();
    assert!(scenes.len() >= 5, "the shipped scenes are missing");
    let mut failures = Vec::new();
    for choice in &scenes {
        let [identity, accumulation] = verdicts(choice);
        let broken = |verdicts: &[Verdict]| {
            verdicts
                .iter()
                .any(|verdict| matches!(verdict.outcome, Outcome::Broken { .. }))
        };
        let noisy = |verdicts: &[Verdict]| {
            verdicts
                .iter()
                .any(|verdict| matches!(verdict.outcome, Outcome::TooNoisy { .. }))
        };
        let name = &choice.scene.name;
        println!("{name}, identity:\n{}", describe(&identity));
        println!("{name}, 64 sub-frames:\n{}", describe(&accumulation));
        if !broken(&identity) {
            failures.push(format!("{name}: the identity keeps every bound"));
        }
        if broken(&accumulation) {
            failures.push(format!("{name}: 64 sub-frames break a bound"));
        }
        if noisy(&identity) {
            failures.push(format!(
                "{name}: a bound is stricter than the truth's noise can carry"
            ));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn every_metric_can_be_bounded_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bounds.toml");
    for metric in Metric::all() {
        std::fs::write(&path, format!("{metric} = 0.25\n")).unwrap();
        let bounds = suite::read_bounds(folder.path(), folder.path());
        if metric.report_only().is_some() {
            let message = bounds.unwrap_err().to_string();
            assert!(message.contains("is for reports and no bound"), "{message}");
            continue;
        }
        let bounds = bounds.unwrap();
        assert_eq!(
            bounds.into_iter().collect::<Vec<_>>(),
            [(metric.name(), 0.25)]
        );
    }
    for (text, expected) in [
        (
            "flip = 0.1",
            "metric \"flip\" is unknown; allowed: mse_moving",
        ),
        (
            "flip_moving = nan",
            "flip_moving = NaN; allowed: a finite number",
        ),
        ("flip_moving = \"low\"", "bounds.toml"),
        ("flip_moving", "bounds.toml"),
    ] {
        std::fs::write(&path, text).unwrap();
        let message = suite::read_bounds(folder.path(), folder.path())
            .unwrap_err()
            .to_string();
        assert!(message.contains(expected), "{text}: {message}");
    }
}

#[test]
fn a_scenes_own_bounds_override_those_of_all_scenes() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("fan");
    std::fs::create_dir(&scene).unwrap();
    std::fs::write(
        folder.path().join("bounds.toml"),
        "flip_moving = 0.1\nextent = 0.2\n",
    )
    .unwrap();
    std::fs::write(scene.join("bounds.toml"), "flip_moving = 0.3\n").unwrap();
    let bounds = suite::read_bounds(folder.path(), &scene).unwrap();
    assert_eq!(bounds["flip_moving"], 0.3);
    assert_eq!(bounds["extent"], 0.2);
}
