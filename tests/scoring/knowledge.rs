//! Scores of what one frame knows, probes of a filter's taps, and skill over no blur.

use frame::{Frame, Image, Picture, Raster, Truth};
use metrics::{Probes, Reference, Sharp, regions};
use tests::random::Random;
use tests::synthetic::{Sampling, VIEWING};
use tests::text::assert_contains;

use crate::{
    assert_near, assert_scores, clean_truth, find_reason, find_value, measure_scores, mix,
    sliding_disc, smear,
};

fn frame_and_truth() -> (Frame, Truth) {
    (sliding_disc().frame(), clean_truth(&sliding_disc()))
}

fn make_reference<'a>(frame: &Frame, truth: &'a Truth) -> Reference<'a> {
    Reference::new(frame, truth, None, &VIEWING).expect("they agree")
}

fn brighten(image: &Image, by: f32, where_: impl Fn(u32, u32) -> bool) -> Image {
    Raster::from_fn(image.width, image.height, |x, y| {
        let add = if where_(x, y) { by } else { 0.0 };
        image.at(x, y).map(|c| c + add)
    })
}

#[test]
fn errors_are_split_into_knowable_and_unknowable() {
    let (frame, mut truth) = frame_and_truth();
    // The right half of the picture cannot be known.
    truth.support.unknowable = Raster::from_fn(72, 48, |x, _| x >= 36);
    let pools = regions(&truth);
    let count = |mask: &Raster<bool>| mask.pixels.iter().filter(|inside| **inside).count();
    let [known, unknown] = [&pools.knowable, &pools.unknowable].map(count);
    assert_eq!(known + unknown, count(&pools.moving));
    assert!(known > 100 && unknown > 100);
    let mean = truth.mean();
    let mut guessed = mean.clone();
    guessed.color = brighten(&mean.color, 0.1, |x, _| x >= 36);
    let part = unknown as f64 / (known + unknown) as f64;
    // Squares of 32-bit sums.
    let expected = [
        ("mse_knowable", 0.0, 1e-9),
        ("mse_unknowable", 0.01, 1e-6),
        ("mse_moving", 0.01 * part, 1e-6),
    ];
    let scores = measure_scores(&guessed, &frame, &truth);
    assert_scores("a guess", &scores, &expected);

    let (frame, truth) = frame_and_truth();
    let scores = measure_scores(&truth.mean(), &frame, &truth);
    let reason = find_reason(&scores, "flip_unknowable");
    let words = "shows all that the shutter sees";
    assert!(reason.contains(words), "{reason}");
}

#[test]
fn moving_shading_is_separated_from_visibility() {
    let (frame, mut truth) = frame_and_truth();
    // At the instant everything was darker: a shadow that left.
    for half in &mut truth.at_instant {
        half.shift = half.shift.map(|shift| shift.map(|c| c - 0.1));
    }
    let output = |color: &Image| Picture {
        color: color.clone(),
        ..truth.mean()
    };
    let frozen = measure_scores(&output(&truth.frozen_mean()), &frame, &truth);
    let right = measure_scores(&truth.mean(), &frame, &truth);
    for (scores, against_truth, against_frozen) in [(&frozen, 0.01, 0.0), (&right, 0.0, 0.01)] {
        let expected = [
            ("mse_moving", against_truth, 1e-6),
            ("mse_frozen", against_frozen, 1e-6),
            ("mse_shading", 0.01, 1e-6),
        ];
        assert_scores("a shadow that left", scores, &expected);
    }
    assert_eq!(find_value(&frozen, "flip_frozen"), 0.0);
    assert!(find_value(&right, "flip_frozen") > 0.01);
}

#[test]
fn a_change_at_still_pixels_is_contamination() {
    let (frame, truth) = frame_and_truth();
    let moving = regions(&truth).moving;
    let mean = truth.mean();
    let changed = |by: f32, what: bool| Picture {
        color: brighten(&mean.color, by, |x, y| *moving.at(x, y) == what),
        ..mean.clone()
    };
    // Root mean square of the change over the brightness, with a hundredth of white added.
    let still = frame.color.pixels.iter().zip(&moving.pixels);
    let squares = still.filter(|(_, moves)| !**moves).map(|(color, _)| {
        let squares: f64 = color.iter().map(|c| f64::from(*c).powi(2)).sum();
        let brightness = (squares / 3.0).sqrt();
        (0.05 / (brightness + 0.01)).powi(2)
    });
    let squares: Vec<f64> = squares.collect();
    let share = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
    for (picture, expected) in [(changed(0.05, false), share), (changed(0.5, true), 0.0)] {
        let expected = [("static_contamination", expected, 1e-6)];
        let scores = measure_scores(&picture, &frame, &truth);
        assert_scores("a change", &scores, &expected);
    }
}

const SKILLS: [&str; 3] = ["skill_mse", "skill_flip", "skill_label_tv"];

#[test]
fn skill_is_the_share_of_the_way_from_a_sharp_picture_to_the_one_frame_oracle() {
    let (frame, truth) = frame_and_truth();
    let nothing = frame.picture();
    let oracle = mix(&nothing, &truth.mean(), 0.75);
    let reference = make_reference(&frame, &truth);
    let reference = reference
        .with_ends(&Sharp::Frame(nothing.clone()), &oracle)
        .unwrap();
    let scores_of = |picture: &Picture| reference.measure(picture).unwrap().scores;
    for (picture, expected) in [(&nothing, 0.0), (&oracle, 1.0)] {
        let expected = SKILLS.map(|name| (name, expected, 1e-6));
        assert_scores("an end", &scores_of(picture), &expected);
    }
    // Half of the way to the truth leaves half of the pixels' time with the wrong object, and the
    // oracle leaves a quarter. Squared errors leave the squares of both.
    let half = scores_of(&mix(&nothing, &truth.mean(), 0.5));
    let expected = [
        ("skill_label_tv", 0.5 / 0.75, 1e-5),
        ("skill_mse", 0.75 / (1.0 - 1.0 / 16.0), 1e-5),
    ];
    assert_scores("half of the way", &half, &expected);
    // The truth is better than any one-frame oracle. A negative with mover and background exchanged
    // is worse than none.
    let worse = Picture {
        color: (frame.color).map(|color| color.map(|part| (1.0 - part).max(0.0))),
        coverage: frame.coverage.iter().rev().cloned().collect(),
    };
    for name in SKILLS {
        assert!(find_value(&scores_of(&truth.mean()), name) > 1.0, "{name}");
        assert!(find_value(&scores_of(&worse), name) < 0.0, "{name}");
    }
}

#[test]
fn skill_needs_an_oracle_that_beats_no_blur() {
    let (frame, truth) = frame_and_truth();
    let nothing = frame.picture();
    let unknown = measure_scores(&truth.mean(), &frame, &truth);
    let reference = make_reference(&frame, &truth);
    let reference = reference
        .with_ends(&Sharp::Frame(nothing.clone()), &nothing)
        .unwrap();
    let equal = reference.measure(&truth.mean()).unwrap().scores;
    for name in SKILLS {
        let unknown = find_reason(&unknown, name);
        assert_contains(
            &unknown,
            &["no sharp picture of the shutter's middle was given"],
        );
        let equal = find_reason(&equal, name);
        assert_contains(&equal, &["no more than the truth's noise makes"]);
    }
}

/// Returns the probes after a gather with `taps` (offset in whole pixels, weight) at every pixel.
fn gather_probes(taps: &[([i32; 2], f32)]) -> Probes {
    // Far enough from the border that all taps stay in the picture.
    let images = Probes::images(72, 48);
    let outputs = images.each_ref().map(|image| -> Image {
        Raster::from_fn(72, 48, |x, y| {
            let mut sum = [0.0; 3];
            for ([right, down], weight) in taps {
                let u = (x as i32 + right).clamp(0, 71);
                let v = (y as i32 + down).clamp(0, 47);
                let at = image.at(u as u32, v as u32);
                sum = std::array::from_fn(|c| sum[c] + weight * at[c]);
            }
            sum
        })
    });
    Probes::of([&outputs[0], &outputs[1]])
}

#[test]
fn probes_locate_a_filter_s_taps() {
    let (frame, mut truth) = frame_and_truth();
    // The taps are 3 pixels further right on average, at 2 and at 4, in pixels one wide.
    for half in &mut truth.at_instant {
        half.offset = half.offset.map(|_| [3.0, 0.0]);
        let squares = [9.0 + 1.0 + 1.0 / 12.0, 1.0 / 12.0];
        half.spread = half.spread.map(|_| squares);
    }
    let reference = make_reference(&frame, &truth);
    let measured = |taps: &[([i32; 2], f32)]| {
        let scores = reference.measure_probes(&gather_probes(taps)).scores;
        [&scores.unity, &scores.gather_offset, &scores.gather_spread]
            .map(|score| score.value().unwrap())
    };
    let narrow = (1.0f64 + 1.0 / 6.0).sqrt() - (1.0f64 / 6.0).sqrt();
    for (taps, [unity, offset, spread]) in [
        (&[([2, 0], 0.5), ([4, 0], 0.5)][..], [0.0; 3]),
        (&[([2, 4], 0.5), ([4, 4], 0.5)], [0.0, 4.0, 0.0]),
        (&[([3, 0], 1.0)], [0.0, 0.0, narrow]),
        // The middle does not depend on the sum of weights.
        (&[([2, 0], 0.55), ([4, 0], 0.55)], [0.1, 0.0, 0.0]),
    ] {
        let scores = measured(taps);
        assert_near("unity", scores[0], unity, 1e-6);
        // Squares of coordinates up to 36 in 32 bits: 1e-4 of a square pixel.
        assert_near("offset", scores[1], offset, 1e-4);
        assert_near("spread", scores[2], spread, 1e-3);
    }
}

#[test]
fn grain_raises_total_variation_and_a_smooth_ramp_does_not() {
    let (frame, truth) = frame_and_truth();
    let mean = truth.mean();
    let mut random = Random::new(5);
    let mut grainy = mean.clone();
    grainy.coverage[1] = mean.coverage[1].map(|a| {
        let inside = *a > 0.0 && *a < 1.0;
        (a + if inside { random.real(-0.2, 0.2) } else { 0.0 }).clamp(0.0, 1.0)
    });
    let scores = |picture: &Picture| measure_scores(picture, &frame, &truth);
    let [smooth, rough] = [&mean, &grainy].map(scores);
    assert_near("excess", find_value(&smooth, "tv_excess"), 0.0, 1e-9);
    assert!(find_value(&rough, "tv_excess") > 1.0, "{rough:?}");
    assert_near("error", find_value(&smooth, "gradient_error"), 0.0, 1e-12);
    assert!(find_value(&rough, "gradient_error") > 1e-4, "{rough:?}");
    // An even blur twice as long rises and falls only once, and less high.
    let long = scores(&sliding_disc().render(&smear(-2.0, 0.0), Sampling::CLEAN));
    assert!(find_value(&long, "tv_excess") < 0.0, "{long:?}");
}
