//! Noise in the truth, in the ladder and in a picture.
//!
//! Errors are unbiased, floors are the noise of a score, and an accumulation of N sub-frames scores
//! as one of N.

use std::sync::LazyLock;

use frame::{Frame, Image, Ladder, Picture, Truth};
use metrics::{
    Equivalent, LadderRange, Measured, Metric, Reference, Region, Score, Scores, regions,
};
use tests::random::Random;
use tests::synthetic::{Blur, VIEWING};

use crate::{assert_near, dilated, find_score, measure_scores, noisy, sliding_disc, smear};

static FRAME: LazyLock<Frame> = LazyLock::new(|| sliding_disc().frame());

/// Truth with little noise, from other seeds than the pictures measured against it.
static TRUTH: LazyLock<Truth> =
    LazyLock::new(|| sliding_disc().truth([noisy(4096, 1), noisy(4096, 2)]));

fn score(output: &Picture, truth: &Truth) -> Scores {
    measure_scores(output, &FRAME, truth)
}

fn make_reference(ladder: Option<&Ladder>) -> Reference<'static> {
    Reference::new(&FRAME, &TRUTH, ladder, &VIEWING).expect("they agree")
}

/// Scores a blur with as many samples, from its own seed.
fn score_blur(reference: &Reference, blur: &Blur, samples: u32) -> Scores {
    let output = sliding_disc().render(blur, noisy(samples, 9));
    reference.measure(&output).expect("a finite picture").scores
}

/// Returns the mean and standard error of independent values.
fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    (mean, (squares / (count - 1.0) / count).sqrt())
}

/// Returns the mean squared difference of two pictures over the moving region.
fn plain_mse(output: &Picture, truth: &Picture) -> f64 {
    let difference = output.color.zip(&truth.color, |a, b| {
        (0..3).map(|c| f64::from(a[c] - b[c]).powi(2)).sum::<f64>() / 3.0
    });
    let values = regions(&TRUTH).select(Region::Moving, &difference);
    values.iter().sum::<f64>() / values.len() as f64
}

#[test]
fn the_squared_error_is_unbiased_and_the_plain_one_is_not() {
    let nearly_right = sliding_disc().render(&Blur::accumulation(6), noisy(4096, 3));
    // The converged truth's own noise is 1/256 of that of 16 samples.
    let expected = plain_mse(&nearly_right, &TRUTH.mean());
    let mut unbiased = Vec::new();
    let mut plain = Vec::new();
    for seed in 0..200 {
        let truth = sliding_disc().truth([noisy(16, 1000 + seed), noisy(16, 2000 + seed)]);
        unbiased.push(find_score(&score(&nearly_right, &truth), "mse_moving").value);
        plain.push(plain_mse(&nearly_right, &truth.mean()));
    }
    let (mean, error) = mean_and_error(&unbiased);
    assert_near("unbiased", mean, expected, 3.0 * error);
    let (mean, error) = mean_and_error(&plain);
    let bias = mean - expected;
    assert!(bias > 10.0 * error, "plain: {bias} +- {error}");
}

#[test]
fn a_perfect_picture_s_unbiased_error_scatters_by_its_floor() {
    let converged = TRUTH.mean();
    let truth = |seed: u64| sliding_disc().truth([noisy(16, 3000 + seed), noisy(16, 4000 + seed)]);
    let truths = (0..100).map(|seed| score(&converged, &truth(seed)));
    let truths: Vec<Scores> = truths.collect();
    for name in "mse_moving mse_support mse_full relmse_moving mse_frozen".split(' ') {
        let all_scores = truths.iter().map(|scores| find_score(scores, name));
        let all_scores: Vec<Score> = all_scores.collect();
        let root_mean_square = |values: &dyn Fn(&Score) -> f64| {
            let squares = all_scores.iter().map(|score| values(score).powi(2));
            (squares.sum::<f64>() / all_scores.len() as f64).sqrt()
        };
        let scatter = root_mean_square(&|score| score.value);
        let floor = root_mean_square(&|score| score.floor);
        let within = |floors: f64| {
            let inside = |score: &&Score| score.value.abs() <= floors * score.floor;
            all_scores.iter().filter(inside).count()
        };
        // A standard deviation from 100 values errs by a fourteenth; noise that is not normal moves
        // the floor by a fifth.
        let ratio = scatter / floor;
        assert!((0.7..1.25).contains(&ratio), "{name}: {ratio}");
        // Of 100 normal values 68, 95 and 99.7 are inside on average. The limits are four standard
        // deviations lower.
        for (floors, least) in [(1.0, 50), (2.0, 86), (3.0, 96)] {
            assert!(within(floors) >= least, "{name} within {floors} floors");
        }
    }
}

#[test]
fn a_converged_picture_scores_about_the_floor_of_a_noisy_truth() {
    let converged = TRUTH.mean();
    let truth = sliding_disc().truth([noisy(128, 5), noisy(128, 6)]);
    let scores = score(&converged, &truth);
    let names =
        "flip_moving flip_p95_moving flip_hdr_moving label_tv label_tv_p95 deficit object_label_tv";
    for name in names.split(' ') {
        let score = find_score(&scores, name);
        let ratio = score.value / score.floor;
        // Half A and the mean differ by the mean's noise, drawn once more: equal but for chance
        // and, for FLIP, for noise in both pictures.
        assert!((0.7..1.4).contains(&ratio), "{name}: {score:?}");
    }
    for name in ["lateral_growth", "row_gain", "row_loss"] {
        let Score { value, floor } = find_score(&scores, name);
        assert!(floor > 0.0, "{name}: {floor}");
        assert!(value < 2.0 * floor, "{name}: {value} {floor}");
    }
    // Below the noise, PSNR stays at the value that the truth can support.
    let truth = |seed: u64| sliding_disc().truth([noisy(128, 500 + seed), noisy(128, 600 + seed)]);
    let mut scores = (0..).map(|seed| score(&converged, &truth(seed)));
    let below_0 = scores.find(|scores| find_score(scores, "mse_moving").value < 0.0);
    let psnr = find_score(&below_0.expect("every other one is"), "psnr_moving");
    assert_eq!(psnr.value, psnr.floor);
}

#[test]
fn floors_fall_as_the_truth_converges() {
    let output = &TRUTH.halves[0];
    let [coarse, fine] = [16, 1024].map(|samples| {
        let truth = sliding_disc().truth([noisy(samples, 7), noisy(samples, 8)]);
        score(output, &truth)
    });
    for metric in Metric::all() {
        let floor_in = |scores: &Scores| match scores.get(metric) {
            Measured::Score(score) => Some(score.floor),
            Measured::NotApplicable { .. } => None,
        };
        let (Some(coarse), Some(fine)) = (floor_in(&coarse), floor_in(&fine)) else {
            continue;
        };
        let name = metric.name();
        // The still background has no noise, nothing is shaded anew, the margin hides noise, and
        // one sum can be small by chance.
        let has_none = name.contains("static") || name.starts_with("bleed");
        if has_none || ["mse_shading", "energy"].contains(&name.as_str()) {
            continue;
        }
        let falls = match name.split('_').next() {
            Some("psnr") => fine > coarse + 6.0,
            Some("ssim") => 1.0 - fine < 0.5 * (1.0 - coarse),
            _ => fine < 0.5 * coarse,
        };
        assert!(falls, "{name}: {coarse:?} {fine:?}");
    }
}

#[test]
fn an_accumulation_of_n_sub_frames_scores_as_n() {
    let ladder = sliding_disc().ladder(1024, [1000, 2000]);
    let reference = make_reference(Some(&ladder));
    for subframes in [2, 4, 8, 16] {
        // Noise of the picture and of a rung's difference are about equal.
        let scores = score_blur(&reference, &Blur::accumulation(subframes), 1024);
        for name in ["n_eq", "n_eq_flip", "n_eq_label_tv"] {
            let ratio = find_score(&scores, name).value / f64::from(subframes);
            assert_near(name, ratio, 1.0, 0.05);
        }
    }
}

#[test]
fn noise_in_the_ladder_does_not_lower_the_bar() {
    let ladder = sliding_disc().ladder(8, [5000, 6000]);
    let reference = make_reference(Some(&ladder));
    for subframes in [4, 8] {
        let scores = score_blur(&reference, &Blur::accumulation(subframes), 4096);
        let ratio = find_score(&scores, "n_eq").value / f64::from(subframes);
        // Two halves of 8 samples: unbiased, their noise scatters the counts by 3 %; counted as
        // error, it adds at least 14 %.
        assert_near("n_eq", ratio, 1.0, 0.1);
    }
}

#[test]
fn counts_beyond_the_ladder_are_marked() {
    let ladder = sliding_disc().ladder(256, [3000, 4000]);
    let reference = make_reference(Some(&ladder));
    let range = |blur: Blur| {
        let scores = score_blur(&reference, &blur, 4096);
        match scores.equivalent_subframes.label_total_variation {
            Equivalent::Subframes(subframes) => subframes.range,
            Equivalent::NotApplicable { reason } => panic!("{reason}"),
        }
    };
    assert_eq!(range(Blur::TRUE), LadderRange::Above);
    assert_eq!(range(Blur::accumulation(3)), LadderRange::Within);
    assert_eq!(range(smear(0.0, 1.0)), LadderRange::Below);
}

#[test]
fn frames_of_noise_separate_variance_from_bias() {
    let reference = make_reference(None);
    let truth = TRUTH.mean().color;
    let (offset, amplitude, frames) = (0.25, 0.5, 4);
    let mut random = Random::new(7);
    let mut biases = Vec::new();
    let mut variances = Vec::new();
    for _ in 0..50 {
        let outputs: Vec<Image> = (0..frames)
            .map(|_| truth.map(|color| color.map(|c| c + offset as f32 + random.real(-0.5, 0.5))))
            .collect();
        let jitter = reference.jitter(&outputs).expect("something moves");
        assert_eq!(jitter.frames, frames);
        biases.push(jitter.bias);
        variances.push(jitter.variance);
    }
    // An even distribution of half-width a has the variance a^2 / 3. Few frames bias neither part.
    for (values, expected) in [
        (biases, offset * offset),
        (variances, amplitude * amplitude / 3.0),
    ] {
        let (mean, error) = mean_and_error(&values);
        assert!(error < 0.02 * expected, "too few to tell");
        assert_near("mean", mean, expected, 4.0 * error);
    }
}

#[test]
fn a_filter_without_noise_has_no_variance() {
    let reference = make_reference(None);
    let outputs = vec![FRAME.color.clone(); 3];
    let jitter = reference.jitter(&outputs).expect("something moves");
    assert_eq!((jitter.variance, jitter.noise_share()), (0.0, 0.0));
    let whole = find_score(&score(&FRAME.picture(), &TRUTH), "mse_moving").value;
    assert_near("bias", jitter.bias, whole, 1e-9);
}

#[test]
fn a_reference_with_known_errors_and_one_of_a_part_score_like_one_by_itself() {
    let scene = sliding_disc();
    let whole = scene.truth([noisy(8, 1), noisy(8, 2)]);
    let part = scene.truth([noisy(4, 3), noisy(4, 4)]);
    let frame = scene.frame();
    let output = scene.render(&dilated(2.0), noisy(8, 5));
    let whole_reference = Reference::new(&frame, &whole, None, &VIEWING).unwrap();
    let by_itself = Reference::new(&frame, &part, None, &VIEWING).unwrap();
    let scores = |reference: &Reference| reference.measure(&output).unwrap().scores;
    assert_ne!(scores(&whole_reference), scores(&by_itself));

    let of_part = whole_reference.part(&frame, &part, None).unwrap();
    assert_eq!(scores(&of_part), scores(&by_itself));
    let known = by_itself.errors().clone();
    assert_eq!(of_part.errors(), &known);
    let again = Reference::with_errors(&frame, &part, &VIEWING, known).unwrap();
    assert_eq!(scores(&again), scores(&by_itself));
}
