//! Scores of what one frame knows, probes of a filter's taps, and skill over no blur.

use frame::{Frame, Image, Picture, Raster, Region, Truth};
use metrics::{Measured, Probes, Reference, Scores, regions};
use tests::random::Random;
use tests::synthetic::{Blur, Sampling, VIEWING};

use crate::{clean_truth, find_value, sliding_disc};

fn frame_and_truth() -> (Frame, Truth) {
    (sliding_disc().frame(), clean_truth(&sliding_disc()))
}

fn make_reference<'a>(frame: &Frame, truth: &'a Truth) -> Reference<'a> {
    Reference::new(frame, truth, None, &VIEWING).expect("they agree")
}

fn measure_scores(frame: &Frame, truth: &Truth, output: &Picture) -> Scores {
    let measured = make_reference(frame, truth).measure(output);
    measured.expect("a finite picture").scores
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
    assert_eq!(
        count(&pools.knowable) + count(&pools.unknowable),
        count(&pools.moving)
    );
    assert!(count(&pools.knowable) > 100 && count(&pools.unknowable) > 100);
    let mean = truth.mean();
    let guessed = Picture {
        color: brighten(&mean.color, 0.1, |x, _| x >= 36),
        ..mean.clone()
    };
    let scores = measure_scores(&frame, &truth, &guessed);
    // Squares of 32-bit sums.
    assert!(find_value(&scores, "mse_knowable").abs() < 1e-9);
    assert!((find_value(&scores, "mse_unknowable") - 0.01).abs() < 1e-6);
    let part = count(&pools.unknowable) as f64 / count(&pools.moving) as f64;
    assert!((find_value(&scores, "mse_moving") - 0.01 * part).abs() < 1e-6);

    let (frame, truth) = frame_and_truth();
    let scores = measure_scores(&frame, &truth, &truth.mean());
    let Measured::NotApplicable { reason } = scores.get("flip_unknowable".parse().unwrap()) else {
        panic!("nothing is unknowable there");
    };
    assert!(
        reason.contains("shows all that the shutter sees"),
        "{reason}"
    );
}

#[test]
fn moving_shading_is_separated_from_visibility() {
    let (frame, mut truth) = frame_and_truth();
    // At the instant everything was darker: a shadow that left.
    for half in &mut truth.at_instant {
        half.frozen = half.frozen.map(|color| color.map(|c| c - 0.1));
    }
    let output = |color: &Image| Picture {
        color: color.clone(),
        ..truth.mean()
    };
    let frozen = measure_scores(&frame, &truth, &output(&truth.at_instant_mean().frozen));
    let right = measure_scores(&frame, &truth, &truth.mean());
    for (scores, against_truth, against_frozen) in [(&frozen, 0.01, 0.0), (&right, 0.0, 0.01)] {
        assert!((find_value(scores, "mse_moving") - against_truth).abs() < 1e-6);
        assert!((find_value(scores, "mse_frozen") - against_frozen).abs() < 1e-6);
        assert!((find_value(scores, "mse_shading") - 0.01).abs() < 1e-6);
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
    for (picture, expected) in [(changed(0.05, false), 0.05), (changed(0.5, true), 0.0)] {
        let found = find_value(
            &measure_scores(&frame, &truth, &picture),
            "static_contamination",
        );
        assert!(
            (found - expected).abs() < 1e-6,
            "{found}, expected {expected}"
        );
    }
}

const SKILLS: [&str; 3] = ["skill_mse", "skill_flip", "skill_label_tv"];

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

#[test]
fn skill_is_the_share_of_the_way_from_a_sharp_picture_to_the_one_frame_oracle() {
    let (frame, truth) = frame_and_truth();
    let nothing = frame.picture();
    let oracle = mix(&nothing, &truth.mean(), 0.75);
    let reference = make_reference(&frame, &truth);
    let reference = reference.with_ends(&nothing, &oracle).unwrap();
    let scores_of = |picture: &Picture| reference.measure(picture).unwrap().scores;
    for (picture, expected) in [(&nothing, 0.0), (&oracle, 1.0)] {
        let scores = scores_of(picture);
        for name in SKILLS {
            assert!(
                (find_value(&scores, name) - expected).abs() < 1e-6,
                "{name}"
            );
        }
    }
    // Half of the way to the truth leaves half of the pixels' time with the wrong object, and the oracle leaves a
    // quarter. Squared errors leave the squares of both.
    let half = scores_of(&mix(&nothing, &truth.mean(), 0.5));
    assert!((find_value(&half, "skill_label_tv") - 0.5 / 0.75).abs() < 1e-5);
    assert!((find_value(&half, "skill_mse") - 0.75 / (1.0 - 1.0 / 16.0)).abs() < 1e-5);
    // The truth is better than any one-frame oracle. A negative with mover and background exchanged is worse than
    // none.
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
    let reason = |scores: &Scores, name: &str| match scores.get(name.parse().unwrap()) {
        Measured::NotApplicable { reason } => reason,
        Measured::Score(score) => panic!("{name}: {score:?}"),
    };
    let unknown = measure_scores(&frame, &truth, &truth.mean());
    let reference = make_reference(&frame, &truth);
    let reference = reference.with_ends(&nothing, &nothing).unwrap();
    let equal = reference.measure(&truth.mean()).unwrap().scores;
    for name in SKILLS {
        assert!(
            reason(&unknown, name).contains("no sharp picture of the shutter's middle was given")
        );
        assert!(reason(&equal, name).contains("no more than the truth's noise makes"));
    }
}

/// Returns the probes after a gather that takes `taps` (offset in whole pixels, weight) at every pixel.
fn gather_probes(taps: &[([i32; 2], f32)]) -> Probes {
    // Far enough from the border that all taps stay in the picture.
    let images = Probes::images(72, 48);
    let outputs = images.each_ref().map(|image| -> Image {
        Raster::from_fn(72, 48, |x, y| {
            let mut sum = [0.0; 3];
            for ([right, down], weight) in taps {
                let at = image.at(
                    (x as i32 + right).clamp(0, 71) as u32,
                    (y as i32 + down).clamp(0, 47) as u32,
                );
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
    // The taps lie 3 pixels further right on average, at 2 and at 4, in pixels one wide.
    for half in &mut truth.at_instant {
        half.offset = half.offset.map(|_| [3.0, 0.0]);
        half.spread = half
            .spread
            .map(|_| [9.0 + 1.0 + 1.0 / 12.0, 0.0, 1.0 / 12.0]);
    }
    let reference = make_reference(&frame, &truth);
    let measured = |taps: &[([i32; 2], f32)]| reference.measure_probes(&gather_probes(taps)).scores;
    let number = |measured: &Measured| measured.value().unwrap();

    let right = measured(&[([2, 0], 0.5), ([4, 0], 0.5)]);
    // Squares of coordinates up to 36 in 32 bits: 1e-4 of a square pixel.
    assert!(number(&right.unity) < 1e-6);
    assert!(number(&right.gather_offset) < 1e-4, "{right:?}");
    assert!(number(&right.gather_spread) < 1e-3, "{right:?}");

    let shifted = measured(&[([2, 4], 0.5), ([4, 4], 0.5)]);
    assert!((number(&shifted.gather_offset) - 4.0).abs() < 1e-4);
    assert!(number(&shifted.gather_spread) < 1e-3);

    let narrow = measured(&[([3, 0], 1.0)]);
    assert!(number(&narrow.gather_offset) < 1e-4);
    let expected = (1.0f64 + 1.0 / 6.0).sqrt() - (1.0f64 / 6.0).sqrt();
    assert!((number(&narrow.gather_spread) - expected).abs() < 1e-3);

    let bright = measured(&[([2, 0], 0.55), ([4, 0], 0.55)]);
    assert!((number(&bright.unity) - 0.1).abs() < 1e-6);
    // The middle does not depend on the sum of weights.
    assert!(number(&bright.gather_offset) < 1e-4);
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
    let excess =
        |picture: &Picture| find_value(&measure_scores(&frame, &truth, picture), "tv_excess");
    assert!(excess(&mean).abs() < 1e-9);
    assert!(excess(&grainy) > 1.0, "{}", excess(&grainy));
    // An even blur twice as long rises and falls only once, and less high.
    let long = sliding_disc().render(
        &Blur {
            from: -2.0,
            ..Blur::TRUE
        },
        Sampling::CLEAN,
    );
    assert!(excess(&long) < 0.0, "{}", excess(&long));
    let steep =
        |picture: &Picture| find_value(&measure_scores(&frame, &truth, picture), "gradient_error");
    assert!(steep(&mean) < 1e-12 && steep(&grainy) > 1e-4);
}

#[test]
fn every_region_pools_its_own_pixels() {
    let names: Vec<&str> = Region::ALL.map(Region::name).to_vec();
    assert_eq!(
        names,
        [
            "moving",
            "support",
            "static",
            "full",
            "knowable",
            "unknowable"
        ]
    );
}
