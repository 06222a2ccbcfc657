//! Wrong blurs of known wrongness: each score says what was done, and stays silent about what was not.

mod along;
mod beside;
mod mattes;

use std::sync::LazyLock;

use frame::{Frame, Picture, Truth};
use metrics::{Measured, Metric, Reference, Score, Scores};
use tests::synthetic::{Blur, Object, Sampling, Scene, Shape, VIEWING};

const RADIUS: f64 = 14.0;

const TRAVEL: f64 = 30.0;

const ANGLES: [f64; 4] = [0.0, 30.0, 45.0, 90.0];

/// Rows of pixels at an angle to the motion keep their mass only as well as a box pixel samples the outline: measured
/// below 0.02 px over the angles here; a filter's bleed that matters is above 0.2 px.
const ROWS: f64 = 0.05;

/// Sums of single-precision mattes, sampled 512 times: what is exactly 0 by geometry.
const NOTHING: f64 = 1e-6;

/// Scores of the mass that rows along the motion gain or lose.
const ROW_MASS: [&str; 3] = ["lateral_growth", "row_gain", "row_loss"];

fn direction(degrees: f64) -> [f64; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [cos, sin]
}

/// A shape whose smear has its middle a little off the picture's, and stays inside when it is too long or too late.
fn slide(shape: Shape, degrees: f64) -> Scene {
    let along = direction(degrees);
    Scene {
        width: 128,
        height: 116,
        objects: vec![Object::sliding(
            shape,
            [
                64.3 + along[0] * TRAVEL / 2.0,
                58.2 + along[1] * TRAVEL / 2.0,
            ],
            along.map(|component| component * TRAVEL),
        )],
    }
}

/// A scene with its frame and truth.
struct Case {
    scene: Scene,
    frame: Frame,
    truth: Truth,
}

impl Case {
    fn new(scene: Scene) -> Self {
        Self {
            frame: scene.frame(),
            truth: scene.truth([Sampling::CLEAN; 2]),
            scene,
        }
    }

    fn score_pictures<const N: usize>(&self, pictures: [Picture; N]) -> [Scores; N] {
        let reference = Reference::new(&self.frame, &self.truth, None, &VIEWING)
            .expect("frame and truth belong together");
        pictures.map(|picture| {
            reference
                .measure(&picture)
                .expect("a finite picture")
                .scores
        })
    }

    fn score_blurs<const N: usize>(&self, blurs: [Blur; N]) -> [Scores; N] {
        self.score_pictures(blurs.map(|blur| self.scene.render(&blur, Sampling::CLEAN)))
    }
}

/// A disc that slides at each of the angles.
static DISCS: LazyLock<[Case; 4]> =
    LazyLock::new(|| ANGLES.map(|degrees| Case::new(slide(Shape::Disc(RADIUS), degrees))));

fn discs() -> impl Iterator<Item = (f64, &'static Case)> {
    ANGLES.into_iter().zip(DISCS.iter())
}

fn read_score(scores: &Scores, name: &str) -> f64 {
    let metric: Metric = name.parse().expect("a metric's name");
    match scores.get(metric) {
        Measured::Score(Score { value, .. }) => value,
        Measured::NotApplicable { reason } => panic!("{name} is not applicable: {reason}"),
    }
}

#[track_caller]
fn assert_near(what: &str, found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{what}: {found}, expected {expected} within {tolerance}"
    );
}
