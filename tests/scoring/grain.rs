//! Grain: what it sees, what it forgives, and its floor.

use frame::{Picture, Plane, Raster};
use metrics::{Score, regions};
use tests::random::Random;
use tests::synthetic::{Blur, Sampling};

use crate::decoy_matrix::decoys::blur_isotropically;
use crate::{
    assert_near, clean_truth, find_score, find_value, measure_scores, noisy, sliding_disc,
};

/// Multiplies the light of a picture.
fn times(picture: &Picture, factors: &Plane) -> Picture {
    Picture {
        color: (picture.color).zip(factors, |color, factor| color.map(|part| part * factor)),
        ..picture.clone()
    }
}

fn checkerboard(picture: &Picture, part: f32) -> Plane {
    let (width, height) = (picture.color.width, picture.color.height);
    Raster::from_fn(width, height, |x, y| match (x + y) % 2 {
        0 => 1.0 + part,
        _ => 1.0 - part,
    })
}

fn white_noise(picture: &Picture, part: f32) -> Plane {
    let mut random = Random::new(3);
    let reach = part * 3f32.sqrt();
    picture.color.map(|_| 1.0 + random.real(-reach, reach))
}

#[test]
fn grain_is_the_standard_deviation_of_noise_and_sees_patterns_and_not_blurs() {
    let (frame, truth) = (sliding_disc().frame(), clean_truth(&sliding_disc()));
    let right = truth.mean();
    let grain = |picture: &Picture| {
        let scores = measure_scores(picture, &frame, &truth);
        find_value(&scores, "grain_support")
    };
    assert_eq!(grain(&right), 0.0);
    for part in [0.02, 0.1] {
        let expected = f64::from(part);
        // Some hundreds of pixels, many at edges, where brightness is averaged: measured 10 % too
        // high.
        let score = grain(&times(&right, &white_noise(&right, part)));
        assert_near("noise", score, expected, 0.15 * expected);
        // A checkerboard is all at the highest frequency: 16 / 6 of white noise's, over what white
        // noise has left.
        let score = grain(&times(&right, &checkerboard(&right, part)));
        assert_near("a checkerboard", score, 2.79 * expected, 0.42 * expected);
    }
    // Scores of a picture that is much too blurred, or shows no blur at all, where 2 % of grain
    // would be 0.02.
    for (what, wrong) in [
        ("blurred", blur_isotropically(&right, 2.0)),
        (
            "sharp",
            sliding_disc().render(&Blur::IDENTITY, Sampling::CLEAN),
        ),
    ] {
        let score = grain(&wrong);
        assert!(score < 0.01, "{what}: {score}");
    }
}

#[test]
fn grain_in_a_part_of_what_moves_is_seen() {
    let (frame, truth) = (sliding_disc().frame(), clean_truth(&sliding_disc()));
    let right = truth.mean();
    let moving = regions(&truth).support;
    let columns: Vec<u32> = (0..moving.width)
        .filter(|x| (0..moving.height).any(|y| *moving.at(*x, y)))
        .collect();
    let middle = columns[columns.len() / 2];
    for (what, is_left) in [("left", true), ("right", false)] {
        let noise = white_noise(&right, 0.04);
        let half = Raster::from_fn(moving.width, moving.height, |x, y| {
            if (x < middle) == is_left {
                *noise.at(x, y)
            } else {
                1.0
            }
        });
        let scores = measure_scores(&times(&right, &half), &frame, &truth);
        // Half of the pixels have 4 %: 2.8 % in the root mean square.
        let score = find_value(&scores, "grain_support");
        assert!((0.018..0.036).contains(&score), "{what}: {score}");
    }
}

#[test]
fn a_perfect_picture_s_grain_seldom_exceeds_its_floor_and_hardly_ever_three_times_its_square() {
    let disc = sliding_disc();
    let (frame, converged) = (disc.frame(), disc.render(&Blur::TRUE, noisy(8192, 9)));
    let scores: Vec<Score> = (0..100)
        .map(|seed| {
            let truth = disc.truth([noisy(16, 3000 + seed), noisy(16, 4000 + seed)]);
            find_score(&measure_scores(&converged, &frame, &truth), "grain_support")
        })
        .collect();
    let above = |part: f64| {
        let is_above = |score: &&Score| score.value > part.sqrt() * score.floor * 1.0001;
        scores.iter().filter(is_above).count()
    };
    assert!(scores.iter().all(|score| score.floor > 0.0));
    // The score scatters about 0.
    let negative = scores.iter().filter(|score| score.value < 0.0).count();
    assert!((30..=70).contains(&negative), "{negative}");
    // One normal value of six is above a standard deviation, one of 44 above two and one of 740
    // above three; 4 sigma of 100.
    assert!((2..=31).contains(&above(1.0)), "{}", above(1.0));
    assert!(above(2.0) <= 8, "{}", above(2.0));
    assert!(above(3.0) <= 2, "{}", above(3.0));
}
