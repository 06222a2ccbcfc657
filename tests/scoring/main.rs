//! Scores: metrics, their intervals, and rankings.

mod decoy_matrix;
mod decoys;
mod flip_parity;
mod intervals;
mod invariance;
mod jod_parity;
mod knowledge;
mod noise;
mod ranking;
mod scatter_oracle;
mod scores;
mod sequences;

use frame::Truth;
use metrics::{Measured, Measurement, Scores, measure};
use tests::synthetic::{Blur, Object, Sampling, Scene, Shape, VIEWING};

/// Makes a disc that slides at an angle over a picture of 72x48 pixels.
fn sliding_disc() -> Scene {
    Scene {
        width: 72,
        height: 48,
        objects: vec![Object::sliding(Shape::Disc(9.0), [46.3, 26.2], [24.0, 6.0])],
    }
}

fn noisy(samples: u32, seed: u64) -> Sampling {
    Sampling {
        samples,
        seed: Some(seed),
    }
}

fn clean_truth(scene: &Scene) -> Truth {
    scene.truth([Sampling::CLEAN; 2])
}

fn measure_blur(scene: &Scene, blur: Blur) -> Measurement {
    let output = scene.render(&blur, Sampling::CLEAN);
    measure(&output, &scene.frame(), &clean_truth(scene), None, &VIEWING).expect("they agree")
}

/// Returns a metric's value; fails the test if the metric does not apply.
#[track_caller]
fn find_value(scores: &Scores, name: &str) -> f64 {
    match scores.get(name.parse().expect("a metric's name")) {
        Measured::Score(score) => score.value,
        Measured::NotApplicable { reason } => panic!("{name} does not apply: {reason}"),
    }
}

/// Returns why a metric does not apply; fails the test if it does.
#[track_caller]
fn find_reason(scores: &Scores, metric: &str) -> String {
    match scores.get(metric.parse().expect("a metric's name")) {
        Measured::NotApplicable { reason } => reason,
        Measured::Score(score) => panic!("{metric} scores {} where it means nothing", score.value),
    }
}

#[track_caller]
fn assert_near(what: &str, found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{what}: {found}, expected {expected} within {tolerance}"
    );
}

/// Expects scores, each with its name, value and tolerance.
#[track_caller]
fn assert_scores(what: &str, scores: &Scores, expected: &[(&str, f64, f64)]) {
    for (name, value, tolerance) in expected {
        let what = format!("{name} of {what}");
        assert_near(&what, find_value(scores, name), *value, *tolerance);
    }
}
