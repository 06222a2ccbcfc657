//! Scores: metrics, their intervals, and rankings.

mod decoy_matrix;
mod decoys;
mod flip_parity;
mod grain;
mod intervals;
mod invariance;
mod jod_parity;
mod knowledge;
mod noise;
mod ranking;
mod resemblance;
mod scatter_oracle;
mod scores;
mod sequences;
mod smear;
mod subframes;

use frame::{Frame, Picture, Truth};
use metrics::{Measured, Measurement, Score, Scores, measure};
use tests::near::expect_near as assert_near;
use tests::synthetic::{Blur, Object, Sampling, Scene, Shape, VIEWING};

fn scene([width, height]: [u32; 2], objects: Vec<Object>) -> Scene {
    Scene {
        width,
        height,
        objects,
    }
}

/// Makes a disc that slides at an angle over a picture of 72x48 pixels.
fn sliding_disc() -> Scene {
    let disc = Object::sliding(Shape::Disc(9.0), [46.3, 26.2], [24.0, 6.0]);
    scene([72, 48], vec![disc])
}

fn bar(half: [f64; 2], tilt: f64) -> Shape {
    Shape::Bar { half, tilt }
}

/// Makes the smear between two times, in displacements from the instant; the true one is from -1 to
/// 0.
fn smear(from: f64, to: f64) -> Blur {
    Blur {
        from,
        to,
        ..Blur::TRUE
    }
}

/// Shifts the true smear along and across the motion, in pixels.
fn shifted(shift: [f64; 2]) -> Blur {
    let rest = Blur::TRUE;
    Blur { shift, ..rest }
}

/// Dilates the true smear across the motion to both sides, in pixels.
fn dilated(dilation: f64) -> Blur {
    let rest = Blur::TRUE;
    Blur { dilation, ..rest }
}

/// Mixes two pictures, `part` of the way to the second.
fn mix(first: &Picture, second: &Picture, part: f32) -> Picture {
    let mixed = |a: f32, b: f32| (1.0 - part) * a + part * b;
    Picture {
        color: first.color.zip(&second.color, |a, b| {
            std::array::from_fn(|c| mixed(a[c], b[c]))
        }),
        coverage: (first.coverage.iter().zip(&second.coverage))
            .map(|(a, b)| a.zip(b, |a, b| mixed(*a, *b)))
            .collect(),
    }
}

fn noisy(samples: u32, seed: u64) -> Sampling {
    let seed = Some(seed);
    Sampling { samples, seed }
}

fn clean_truth(scene: &Scene) -> Truth {
    scene.truth([Sampling::CLEAN; 2])
}

fn measure_blur(scene: &Scene, blur: Blur) -> Measurement {
    let output = scene.render(&blur, Sampling::CLEAN);
    measure(&output, &scene.frame(), &clean_truth(scene), None, &VIEWING).expect("they agree")
}

fn measure_scores(output: &Picture, frame: &Frame, truth: &Truth) -> Scores {
    let measured = measure(output, frame, truth, None, &VIEWING);
    measured.expect("they agree").scores
}

/// Returns a metric's score; fails the test if the metric does not apply.
#[track_caller]
fn find_score(scores: &Scores, name: &str) -> Score {
    match scores.get(name.parse().expect("a metric's name")) {
        Measured::Score(score) => score,
        Measured::NotApplicable { reason } => panic!("{name} does not apply: {reason}"),
    }
}

#[track_caller]
fn find_value(scores: &Scores, name: &str) -> f64 {
    find_score(scores, name).value
}

/// Returns the reason why a metric does not apply; fails the test if it applies.
#[track_caller]
fn find_reason(scores: &Scores, metric: &str) -> String {
    match scores.get(metric.parse().expect("a metric's name")) {
        Measured::NotApplicable { reason } => reason,
        Measured::Score(score) => panic!("{metric} scores {} where it means nothing", score.value),
    }
}

/// Expects scores, each with its name, value and tolerance.
#[track_caller]
fn assert_scores(what: &str, scores: &Scores, expected: &[(&str, f64, f64)]) {
    for (name, value, tolerance) in expected {
        let what = format!("{name} of {what}");
        assert_near(&what, find_value(scores, name), *value, *tolerance);
    }
}
