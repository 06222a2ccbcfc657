//! Bars that shipped bounds have to hold: the identity breaks one on every scene with motion, and the mean of 64 sub-frames none.

use std::path::Path;

use cli::SceneChoice;
use frame::{Alignment, Picture};
use judge::{JudgedScore, Outcome};
use metrics::{Measured, Reference};
use suite::Monitor;
use tests::scenes;
use tracer::RenderSettings;

use crate::lock_truths;

/// Scenes in which nothing moves farther than the bounds allow. The tests of the catalogue show by changed pixels what
/// these scenes expose.
const HARDLY_MOVING: [&str; 1] = ["creep"];

/// Judges the instant itself, and the mean of 64 sub-frames.
fn judge_bars(choice: &SceneChoice, out: &Path) -> [Vec<JudgedScore>; 2] {
    let settings = RenderSettings {
        width: 160,
        height: 90,
        ..RenderSettings::default()
    };
    let scene = &choice.scene;
    let rendering = suite::Rendering {
        scene,
        settings,
        out,
        monitor: Monitor::SILENT,
    };
    let frame = rendering.frame().unwrap();
    let truth = rendering.truth(Alignment::Trailing).unwrap();
    let rung = rendering.ladder(&truth).read_or_render(64).unwrap();
    let reference = Reference::new(&frame, &truth, None, &scene.display.into()).unwrap();
    let bounds = judge::read_bounds(scenes(), &choice.folder, Some((160, 90))).unwrap();
    // Bounds for all filters, required or not.
    let bounds = bounds.of("identity", "default");
    let judged = |picture: &Picture| {
        judge::judge_scores(&reference.measure(picture).unwrap().scores, None, &bounds)
    };
    let identity = Picture {
        color: frame.color.clone(),
        coverage: frame.coverage.clone(),
    };
    let mean = Picture::mean(&rung.rungs[0].halves);
    [judged(&identity), judged(&mean)]
}

fn describe(judged: &[JudgedScore]) -> String {
    let lines = judged.iter().map(|judged| {
        let score = match &judged.measured {
            Measured::Score(score) => format!("{:.4}, floor {:.4}", score.value, score.floor),
            Measured::NotApplicable { reason } => reason.clone(),
        };
        let limit = judged.bound.limit;
        format!(
            "  {} {score}, limit {limit}: {:?}",
            judged.metric, judged.outcome
        )
    });
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn the_identity_breaks_a_bound_in_every_moving_scene_and_64_subframes_break_none() {
    let choices = cli::select_scenes(scenes(), &[]).unwrap();
    assert!(choices.len() >= 5, "the shipped scenes are missing");
    let mut failures = Vec::new();
    let (out, _own) = lock_truths();
    for choice in &choices {
        let [identity, accumulation] = judge_bars(choice, &out);
        let broken =
            |judged: &[JudgedScore]| judged.iter().any(|one| one.outcome == Outcome::Broken);
        let noisy =
            |judged: &[JudgedScore]| judged.iter().any(|one| one.outcome == Outcome::TooNoisy);
        let name = &choice.scene.id;
        println!("{name}, identity:\n{}", describe(&identity));
        println!("{name}, 64 sub-frames:\n{}", describe(&accumulation));
        if HARDLY_MOVING.contains(&name.name.as_str()) {
            assert!(!broken(&identity), "{name} is no exception");
        } else if !broken(&identity) {
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
