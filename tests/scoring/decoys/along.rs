//! Errors along the motion: length and position of the smear.

use metrics::{Ideal, ImageMetric, Measured, Metric, Score};
use tests::synthetic::Blur;

use super::{DISCS, NOTHING, RADIUS, ROW_MASS, ROWS, TRAVEL, assert_large, discs};
use crate::{assert_near, assert_scores, find_score, shifted, smear};

/// Returns the standard deviation along the motion, within rows, of a disc smeared over `travel`
/// pixels.
fn spread_of_disc(travel: f64) -> f64 {
    (RADIUS * RADIUS / 4.0 + travel * travel / 12.0).sqrt()
}

#[test]
fn the_truth_itself_scores_perfectly() {
    let [scores] = DISCS[1].score_blurs([Blur::TRUE]);
    for metric in Metric::all() {
        let Measured::Score(score) = scores.get(metric) else {
            continue;
        };
        let perfect = match (metric, metric.ideal()) {
            (_, Ideal::Lowest) => 0.0,
            (_, Ideal::Target(target)) => target,
            (Metric::Image(ImageMetric::Psnr, _), Ideal::Highest) => metrics::PSNR_LIMIT,
            (_, Ideal::Highest) => 1.0,
        };
        assert_near(&metric.name(), score.value, perfect, 1e-9);
    }
}

#[test]
fn blurs_that_only_err_along_the_motion_keep_the_mass_of_every_row() {
    let [few, more, many] = [2, 4, 16].map(Blur::accumulation);
    let blurs = [Blur::IDENTITY, smear(-0.5, 0.0), few, more, many];
    for (degrees, disc) in discs() {
        for (scores, blur) in disc.score_blurs(blurs).iter().zip(blurs) {
            let what = format!("{blur:?} at {degrees} degrees");
            assert_scores(&what, scores, &ROW_MASS.map(|name| (name, 0.0, ROWS)));
            let bleeds = ["bleed_lateral", "bleed_leading", "bleed_trailing"];
            assert_scores(&what, scores, &bleeds.map(|name| (name, 0.0, NOTHING)));
            // Sampling of 512 per pixel, over thousands of pixels.
            assert_scores(&what, scores, &[("energy", 1.0, 1e-3)]);
        }
    }
}

#[test]
fn the_floor_of_growth_is_the_difference_between_the_instant_s_rows() {
    for (degrees, disc) in discs() {
        let [scores] = disc.score_blurs([Blur::IDENTITY]);
        for name in ROW_MASS {
            let Score { value, floor } = find_score(&scores, name);
            // The truth has no noise here, and the identity's rows are the instant's.
            assert_near(&format!("{name} at {degrees} degrees"), floor, value, 1e-12);
        }
    }
}

#[test]
fn a_blur_of_the_wrong_length_is_misplaced_by_half_the_difference() {
    for (degrees, disc) in discs() {
        let lengths = [0.0, 0.5, 1.5];
        let all_scores = disc.score_blurs(lengths.map(|length| smear(-length, 0.0)));
        for (scores, length) in all_scores.iter().zip(lengths) {
            let ahead = TRAVEL * (1.0 - length) / 2.0;
            let extent = spread_of_disc(TRAVEL * length) / spread_of_disc(TRAVEL);
            // Mattes have 512 samples, and rows are one pixel wide at an angle: hundredths of a
            // pixel.
            let expected = [
                ("centroid", ahead, 0.05),
                ("misplacement", ahead.abs(), 0.05),
                ("extent", extent, 0.01),
            ];
            let what = format!("length {length} at {degrees} degrees");
            assert_scores(&what, scores, &expected);
        }
        let what = format!("length 1.5 at {degrees} degrees");
        assert_large(&what, &all_scores[2], "bleed_trailing");
        assert_scores(&what, &all_scores[2], &[("bleed_leading", 0.0, NOTHING)]);
        assert_scores(&what, &all_scores[2], &[("lateral_growth", 0.0, ROWS)]);
    }
}

#[test]
fn a_blur_on_the_wrong_side_of_the_instant_bleeds_ahead() {
    for (degrees, disc) in discs() {
        let [scores] = disc.score_blurs([smear(-0.5, 0.5)]);
        let what = format!("the wrong side at {degrees} degrees");
        assert_large(&what, &scores, "bleed_leading");
        let expected = [
            ("bleed_trailing", 0.0, NOTHING),
            ("centroid", TRAVEL / 2.0, 0.05),
            ("extent", 1.0, 0.01),
            ("lateral_growth", 0.0, ROWS),
        ];
        assert_scores(&what, &scores, &expected);
    }
}

#[test]
fn a_shift_along_the_motion_shows_in_the_signed_centroid() {
    for (degrees, disc) in discs() {
        let shifts = [3.0, -3.0];
        let blurs = shifts.map(|shift| shifted([shift, 0.0]));
        for (scores, shift) in disc.score_blurs(blurs).iter().zip(shifts) {
            let expected = [
                ("centroid", shift, 0.05),
                ("misplacement", 3.0, 0.05),
                ("lateral_growth", 0.0, ROWS),
            ];
            assert_scores(&format!("a shift at {degrees} degrees"), scores, &expected);
        }
    }
}
