//! The interval of a score holds what the score converges to: counted over many noisy truths.

use frame::{Frame, Picture, Truth};
use metrics::{Metric, Reference, Scores};
use rayon::prelude::*;
use suite::{Intervals, intervals, truths_without_pairs};
use tests::synthetic::{Blur, Object, Sampling, Scene, Shape, VIEWING};

/// Noisy truths, each of as many replicates.
const SEEDS: u64 = 200;
const REPLICATES: u64 = 8;

fn noisy(samples: u32, seed: u64) -> Sampling {
    Sampling {
        samples,
        seed: Some(seed),
    }
}

fn scores(picture: &Picture, frame: &Frame, truth: &Truth) -> Scores {
    let reference = Reference::new(frame, truth, None, &VIEWING).unwrap();
    reference.measure(picture).unwrap().scores
}

/// Per noisy truth the intervals of a blur's scores, and the scores that they converge to.
fn measured(blur: &Blur) -> (Vec<Intervals>, Scores) {
    let scene = Scene {
        width: 72,
        height: 48,
        objects: vec![Object::sliding(Shape::Disc(9.0), [46.3, 26.2], [24.0, 6.0])],
    };
    let frame = scene.frame();
    let converged = scene.truth([noisy(8192, 1), noisy(8192, 2)]);
    let picture = scene.render(blur, noisy(4096, 3));
    let found = (0..SEEDS)
        .into_par_iter()
        .map(|seed| {
            let samplings = (0..REPLICATES).map(|index| noisy(16, 100 + REPLICATES * seed + index));
            let replicates = scene.replicates(samplings);
            let truth = Truth {
                // One region for all, that of the converged truth.
                motion: converged.motion.clone(),
                ..Truth::of(&replicates).unwrap()
            };
            let without: Vec<Scores> = (truths_without_pairs(&truth, &replicates).unwrap().iter())
                .map(|part| scores(&picture, &frame, part))
                .collect();
            assert_eq!(without.len() as u64, REPLICATES / 2);
            intervals(&scores(&picture, &frame, &truth), &without, Metric::all())
        })
        .collect();
    (found, scores(&picture, &frame, &converged))
}

/// How many of the intervals of a metric hold the score that it converges to.
fn held(metric: &str, (found, converged): &(Vec<Intervals>, Scores)) -> usize {
    let expected = converged.get(metric.parse().unwrap()).value().unwrap();
    (found.iter().map(|intervals| &intervals[metric]))
        .filter(|interval| (interval.low..=interval.high).contains(&expected))
        .count()
}

#[test]
fn about_95_of_100_intervals_hold_the_converged_score() {
    let wrong = Blur {
        from: -0.7,
        shift: [1.0, 0.5],
        dilation: 1.0,
        ..Blur::TRUE
    };
    // Of 200 intervals 190 on average, with a standard deviation of 3.1: four of them to either side.
    let about_95_percent = 178..200;
    for (name, blur) in [
        ("a wrong blur", wrong),
        ("4 sub-frames", Blur::accumulation(4)),
    ] {
        let measured = measured(&blur);
        for metric in [
            "mse_moving",
            "psnr_moving",
            "relmse_moving",
            "mae_moving",
            "smape_moving",
            "ssim_moving",
            "flip_moving",
            "flip_hdr_moving",
            "mse_full",
            "flip_full",
            "flip_hdr_full",
            "lateral_growth",
            "misplacement",
            "centroid",
            "extent",
            "deficit",
            "energy",
            "object_label_tv",
            "label_tv",
        ] {
            let held = held(metric, &measured);
            println!("{name}, {metric}: {held} of {SEEDS}");
            assert!(
                about_95_percent.contains(&held),
                "{name}, {metric}: {held} of {SEEDS} intervals hold it"
            );
        }
        // Intervals of percentiles are wider than need be.
        for metric in [
            "flip_p95_moving",
            "flip_weighted_median_moving",
            "label_tv_p95",
        ] {
            let held = held(metric, &measured);
            assert!(
                held >= about_95_percent.start,
                "{name}, {metric}: {held} of {SEEDS} intervals hold it"
            );
        }
    }
}

#[test]
fn a_truth_of_two_replicates_has_no_intervals() {
    let scene = Scene {
        width: 24,
        height: 24,
        objects: vec![Object::sliding(Shape::Disc(4.0), [14.0, 12.0], [6.0, 0.0])],
    };
    let replicates = scene.replicates([noisy(16, 1), noisy(16, 2)]);
    let truth = Truth::of(&replicates).unwrap();
    assert!(truths_without_pairs(&truth, &replicates).is_err());
}
