//! Wrong blurs and mattes with known errors. Scores of an error report it, and the others stay
//! silent.

mod along;
mod beside;

use std::sync::LazyLock;

use frame::{Frame, Picture, Truth};
use metrics::{Reference, Scores};
use tests::synthetic::{Blur, Object, Sampling, Scene, Shape, VIEWING, constant};

use crate::{assert_scores, bar, clean_truth, find_value, scene};

const RADIUS: f64 = 14.0;
const TRAVEL: f64 = 30.0;
const ANGLES: [f64; 4] = [0.0, 30.0, 45.0, 90.0];

/// Tolerance of the mass of rows. A box pixel samples the outline of rows at an angle inexactly:
/// measured below 0.02 px over the angles here. A filter's bleed matters above 0.2 px.
const ROWS: f64 = 0.05;

/// Tolerance of sums of single-precision mattes with 512 samples that are exactly 0 by geometry.
const NOTHING: f64 = 1e-6;

/// Scores of the mass that rows along the motion gain or lose.
const ROW_MASS: [&str; 3] = ["lateral_growth", "row_gain", "row_loss"];

/// Makes a shape with its smear's middle a little off the picture's, which stays inside if it is
/// too long or too late.
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
        let score = find_value(scores, name);
        assert!(score > 1.0, "{name} of {what}: {score}");
    }
}

#[test]
fn a_constant_picture_keeps_the_energy_and_fails_everything_else() {
    let [_, disc, ..] = &*DISCS;
    let [scores] = &disc.score_pictures([constant(&disc.truth.mean())]);
    // The mean matte times the pixels, rounded to 32 bits.
    assert_scores("a constant", scores, &[("energy", 1.0, 1e-4)]);
    let pixels = "bleed_lateral bleed_leading bleed_trailing lateral_growth row_loss";
    assert_large("a constant", scores, pixels);
    let others = "misplacement extent label_tv flip_moving".split(' ');
    for (name, least) in others.zip([10.0, 2.0, 0.1, 0.1]) {
        let score = find_value(scores, name);
        assert!(score > least, "{name}: {score}");
    }
}

#[test]
fn a_half_erased_bar_has_half_its_energy_and_half_a_hole() {
    let case = Case::new(slide(bar([25.0, 8.0], 0.0), 0.0));
    let mut faint = case.truth.mean();
    faint.coverage[1] = faint.coverage[1].map(|matte| 0.5 * matte);
    let [scores] = &case.score_pictures([faint]);
    // Halves of 32-bit numbers are exact.
    let halves = ["energy", "deficit", "hole"].map(|name| (name, 0.5, 1e-9));
    assert_scores("half a bar", scores, &halves);
}

#[test]
fn label_total_variation_measures_the_time_of_wrong_objects() {
    // A bar as long as its path, moving along itself: the visible time at each of its three
    // positions is known.
    let case = Case::new(slide(bar([15.0, 8.0], 0.0), 0.0));
    let [scores] = case.score_blurs([Blur::IDENTITY]);
    // Ahead and behind, the truth ramps over 30 px, and the instant covers one of the ramps. |a -
    // a*| sums to 15 px ahead and to 15 px behind, over 16 rows. Half of it counts twice, for bar
    // and background.
    let wrong = 16.0 * (15.0 + 15.0);
    let pixels = metrics::regions(&case.truth).moving.pixels;
    let region = pixels.iter().filter(|inside| **inside).count() as f64;
    // 512 samples per pixel.
    let due = wrong / region;
    assert_scores("no blur", &scores, &[("label_tv", due, 2e-3 * due)]);
}

#[test]
fn a_filter_that_smears_a_still_bar_contaminates_the_occluder() {
    let post = Object::sliding(bar([3.0, 60.0], 0.0), [56.0, 58.0], [0.0, 0.0]);
    let mut scene = slide(Shape::Disc(RADIUS), 0.0);
    scene.objects.insert(0, post);
    let case = Case::new(scene);
    let clean = case.truth.mean();
    let mut smeared = clean.clone();
    for index in 0..smeared.coverage[1].pixels.len() {
        let quarter = smeared.coverage[1].pixels[index] / 4.0;
        smeared.coverage[1].pixels[index] -= quarter;
        smeared.coverage[2].pixels[index] += quarter;
    }
    let scores = case.score_pictures([clean, smeared]);
    for (scores, due) in scores.iter().zip([0.0, 0.25]) {
        let due = [("occluder_contamination", due, NOTHING)];
        assert_scores("a post", scores, &due);
    }
    let metric = "occluder_contamination".parse().expect("a metric's name");
    let (worst, _) = scores[1].worst_object(metric).expect("a still object");
    assert_eq!(worst, "object1");
}
