//! Errors of mattes: energy, holes, and time given to the wrong object.

use tests::synthetic::{Blur, Object, Shape, constant};

use super::{Case, DISCS, NOTHING, RADIUS, assert_large, slide};
use crate::{assert_scores, bar, find_value};

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
        let found = find_value(scores, name);
        assert!(found > least, "{name}: {found}");
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
    // A bar as long as its path, moving along itself: the visible time at each of its three positions is known.
    let case = Case::new(slide(bar([15.0, 8.0], 0.0), 0.0));
    let [scores] = case.score_blurs([Blur::IDENTITY]);
    // Ahead and behind, the truth ramps over 30 px, and the instant covers one of the ramps. |a - a*| sums to 15 px ahead and to 15 px
    // behind, over 16 rows. Half of it counts twice, for bar and background.
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
