//! Wrong blurs with known errors. Scores of an error report it, and the others stay silent.

mod along;
mod beside;
mod mattes;

use std::sync::LazyLock;

use frame::{Frame, Picture, Truth};
use metrics::{Reference, Scores};
use tests::synthetic::{Blur, Object, Sampling, Scene, Shape, VIEWING};

use crate::{clean_truth, find_value, scene};

const RADIUS: f64 = 14.0;
const TRAVEL: f64 = 30.0;
const ANGLES: [f64; 4] = [0.0, 30.0, 45.0, 90.0];

/// Tolerance of the mass of rows. A box pixel samples the outline of rows at an angle inexactly: measured below 0.02 px
/// over the angles here. A filter's bleed matters above 0.2 px.
const ROWS: f64 = 0.05;

/// Tolerance of sums of single-precision mattes with 512 samples that are exactly 0 by geometry.
const NOTHING: f64 = 1e-6;

/// Scores of the mass that rows along the motion gain or lose.
const ROW_MASS: [&str; 3] = ["lateral_growth", "row_gain", "row_loss"];

/// Makes a shape with its smear's middle a little off the picture's, which stays inside if it is too long or too late.
fn slide(shape: Shape, degrees: f64) -> Scene {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let [right, down] = [cos, sin].map(|component| component * TRAVEL);
    let center = [64.3 + right / 2.0, 58.2 + down / 2.0];
    let object = Object::sliding(shape, center, [right, down]);
    scene([128, 116], vec![object])
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
            truth: clean_truth(&scene),
            scene,
        }
    }

    fn score_pictures<const N: usize>(&self, pictures: [Picture; N]) -> [Scores; N] {
        let reference = Reference::new(&self.frame, &self.truth, None, &VIEWING).unwrap();
        pictures.map(|picture| reference.measure(&picture).unwrap().scores)
    }

    fn score_blurs<const N: usize>(&self, blurs: [Blur; N]) -> [Scores; N] {
        self.score_pictures(blurs.map(|blur| self.scene.render(&blur, Sampling::CLEAN)))
    }
}

/// Discs that slide at each of the angles.
static DISCS: LazyLock<[Case; 4]> =
    LazyLock::new(|| ANGLES.map(|degrees| Case::new(slide(Shape::Disc(RADIUS), degrees))));

fn discs() -> impl Iterator<Item = (f64, &'static Case)> {
    ANGLES.into_iter().zip(DISCS.iter())
}

/// Expects scores above 1: pixels that everybody notices.
#[track_caller]
fn assert_large(what: &str, scores: &Scores, names: &str) {
    for name in names.split(' ') {
        let found = find_value(scores, name);
        assert!(found > 1.0, "{name} of {what}: {found}");
    }
}
