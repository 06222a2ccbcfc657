//! Scores from frame to frame.

use std::fs;

use frame::{Image, Raster};
use metrics::SequenceMetric::{
    Error, ErrorAfterTaa, FixedPattern, Flicker, FlickerAfterTaa, FlickerAlong, Jod, Popping,
};
use metrics::{Instant, Measured, SequenceMeasurement, SequenceMetric, SequenceReference};
use tests::random::hash;
use tests::synthetic::{Blur, Object, Sampling, Scene, Shape, VIEWING};
use tests::text::assert_contains;

use crate::{measure_scores, noisy, scene};

/// Compares a score.
#[track_caller]
fn assert_near(actual: f64, expected: f64, tolerance: f64) {
    crate::assert_near("score", actual, expected, tolerance);
}

/// Motion per frame in pixels: whole ones, so that moving a picture along is exact.
const SPEED: [f64; 2] = [4.0, 2.0];
/// Frames of most sequences.
const FRAMES: u32 = 5;
/// Half the width of uniform noise.
const NOISE: f32 = 0.2;
/// Variance of the uniform noise.
const VARIANCE: f64 = (NOISE * NOISE) as f64 / 3.0;

/// Makes a disc that slides over a picture of 96x64 pixels; the shutter is open for half a frame.
fn disc_at(frame: u32, speed: [f64; 2]) -> Scene {
    let center = [0, 1].map(|axis| [30.0, 26.0][axis] + f64::from(frame) * speed[axis]);
    let disc = Object::sliding(Shape::Disc(14.0), center, speed.map(|speed| 0.5 * speed));
    scene([96, 64], vec![disc])
}

fn instant_of(scene: &Scene, samplings: [Sampling; 2]) -> Instant {
    let frame = scene.frame();
    Instant::new(
        &scene.truth(samplings),
        frame.velocity,
        frame.depth,
        frame.object_id,
    )
}

/// Makes scenes, their instants without noise, and their true pictures.
fn slide(speed: [f64; 2]) -> (Vec<Instant>, Vec<Image>) {
    let scenes = (0..FRAMES).map(|frame| disc_at(frame, speed));
    let instants = scenes.map(|scene| instant_of(&scene, [Sampling::CLEAN; 2]));
    let instants: Vec<Instant> = instants.collect();
    let truths = instants.iter().map(|instant| instant.halves[0].clone());
    let truths = truths.collect();
    (instants, truths)
}

/// Adds noise to every picture, with a seed from its frame.
fn add_noise(pictures: &[Image], seed: impl Fn(u64) -> u64) -> Vec<Image> {
    let noisy = |(frame, picture): (u64, &Image)| {
        Raster::from_fn(picture.width, picture.height, |x, y| {
            let key = seed(frame) << 40 | u64::from(y) << 20 | u64::from(x);
            let unit = (hash(key) >> 40) as f32 / (1 << 24) as f32;
            let error = NOISE * (2.0 * unit - 1.0);
            picture.at(x, y).map(|value| value + error)
        })
    };
    (0..).zip(pictures).map(noisy).collect()
}

fn measure_all(instants: &[Instant], pictures: &[Image]) -> SequenceMeasurement {
    let reference = SequenceReference::new(instants.to_vec(), &VIEWING, 30.0);
    reference.measure(pictures).expect("they agree")
}

#[track_caller]
fn value(measured: &SequenceMeasurement, metric: SequenceMetric) -> f64 {
    match measured.scores.get(metric) {
        Measured::Score(score) => score.value,
        Measured::NotApplicable { reason } => panic!("{metric:?} does not apply: {reason}"),
    }
}

fn assert_perfect(instants: &[Instant], truths: &[Image]) {
    let measured = measure_all(instants, truths);
    for metric in SequenceMetric::ALL {
        let perfect = if metric == Jod { 10.0 } else { 0.0 };
        assert_eq!(value(&measured, metric), perfect, "{metric:?}");
    }
}

#[test]
fn the_truth_scores_perfectly() {
    let (instants, truths) = slide(SPEED);
    assert_perfect(&instants, &truths);
}

#[test]
fn a_still_scene_has_no_change_to_get_wrong() {
    let (instants, truths) = slide([0.0, 0.0]);
    assert!(!instants[0].moving.pixels.contains(&true));
    assert_perfect(&instants, &truths);
    // Every frame has the same wrong picture.
    let measured = measure_all(&instants, &add_noise(&truths, |_| 1));
    let changes = [Flicker, FlickerAlong, Popping];
    for metric in changes {
        assert_eq!(value(&measured, metric), 0.0, "{metric:?}");
    }
    // The variance of 6144 pixels scatters by a hundredth.
    let error = value(&measured, Error);
    assert_near(error, VARIANCE, 0.05 * VARIANCE);
}

#[test]
fn noise_that_changes_flickers_and_noise_that_stands_is_dirt() {
    let (instants, truths) = slide(SPEED);
    let changing = measure_all(&instants, &add_noise(&truths, |frame| frame));
    let standing = measure_all(&instants, &add_noise(&truths, |_| 1));
    // Some 1200 pixels move in each of 5 frames: four standard deviations of a mean square are
    // below a tenth.
    let scatter = 0.1 * VARIANCE;
    for measured in [&changing, &standing] {
        assert_near(value(measured, Error), VARIANCE, scatter);
        assert!(value(measured, Jod) < 9.5, "noise is seen");
    }
    for metric in [Flicker, FlickerAlong] {
        assert_near(value(&changing, metric), 2.0 * VARIANCE, 3.0 * scatter);
    }
    // An eye that follows the disc sees new noise on it, and none on the wall around.
    let along = value(&standing, FlickerAlong);
    assert!((0.5 * VARIANCE..1.8 * VARIANCE).contains(&along), "{along}");
    // Rounding to 32 bits only.
    assert_near(value(&standing, Flicker), 0.0, 1e-10);
    // The mean of 25 pixels is subtracted.
    let fine = 0.96 * VARIANCE;
    assert_near(value(&standing, FixedPattern), fine, scatter);
    assert_near(value(&changing, FixedPattern), 0.0, scatter);
    // Temporal antialiasing removes changing noise: a tenth of each new picture counts, and
    // histories begin anew with the sequence and where a disc uncovers the wall.
    for (before, after, part) in [
        (FlickerAlong, FlickerAfterTaa, 0.5),
        (Error, ErrorAfterTaa, 1.0),
    ] {
        let [before, after] = [before, after].map(|metric| value(&changing, metric));
        assert!(after < part * before, "{after} of {before}");
    }
}

#[test]
fn error_that_goes_with_its_object_does_not_flicker_along_the_motion() {
    let (instants, truths) = slide(SPEED);
    let pictures: Vec<Image> = (0..)
        .zip(truths.iter().zip(&instants))
        .map(|(frame, (truth, instant))| {
            let [right, down] = SPEED.map(|speed| frame * speed as i64);
            Raster::from_fn(truth.width, truth.height, |x, y| {
                let is_disc = *instant.object_id.at(x, y) == 1;
                let place = [i64::from(x) - right, i64::from(y) - down];
                let is_striped = is_disc && (place[0] + place[1]).rem_euclid(4) == 0;
                let error = if is_striped { NOISE } else { 0.0 };
                truth.at(x, y).map(|value| value + error)
            })
        })
        .collect();
    let measured = measure_all(&instants, &pictures);
    // Rounding to 32 bits only.
    assert_near(value(&measured, FlickerAlong), 0.0, 1e-10);
    assert!(value(&measured, Flicker) > 1e-3);
}

#[test]
fn popping_is_the_largest_jump_of_an_objects_error() {
    let (instants, truths) = slide(SPEED);
    let errors = [0.1, 0.1, 0.3, 0.25, 0.25];
    let pictures: Vec<Image> = errors
        .iter()
        .zip(truths.iter().zip(&instants))
        .map(|(error, (truth, instant))| {
            truth.zip(&instant.seen[1], |value, seen| {
                value.map(|value| if *seen { value + error } else { value })
            })
        })
        .collect();
    let measured = measure_all(&instants, &pictures);
    // Rounding to 32 bits only.
    assert_near(value(&measured, Popping), 0.2, 1e-6);
}

#[test]
fn accumulations_get_better_with_their_subframes() {
    let speed = [24.0, 4.0];
    let (instants, _) = slide(speed);
    let scores = [1, 2, 4, 8, 16].map(|count| {
        let pictures: Vec<Image> = (0..FRAMES)
            .map(|frame| {
                let blur = Blur::accumulation(count);
                disc_at(frame, speed).render(&blur, Sampling::CLEAN).color
            })
            .collect();
        let measured = measure_all(&instants, &pictures);
        [Error, Flicker, FlickerAlong].map(|metric| value(&measured, metric))
    });
    for pair in scores.windows(2) {
        for (fewer, more) in pair[0].iter().zip(&pair[1]) {
            assert!(more < fewer, "{scores:?}");
        }
    }
}

#[test]
fn noise_of_the_truth_biases_nothing_and_is_the_floor() {
    let instants: Vec<Instant> = (0..FRAMES)
        .map(|frame| {
            let seeds = [2 * u64::from(frame), 2 * u64::from(frame) + 1];
            let samplings = seeds.map(|seed| noisy(16, seed + 1));
            instant_of(&disc_at(frame, SPEED), samplings)
        })
        .collect();
    let (_, truths) = slide(SPEED);
    let measured = measure_all(&instants, &truths);
    for metric in [Error, Flicker, FlickerAlong, FixedPattern] {
        let Measured::Score(score) = measured.scores.get(metric) else {
            panic!("{metric:?} applies");
        };
        // The floor is one standard deviation, and noise of edges has heavy tails.
        let is_within = score.value.abs() < 4.0 * score.floor;
        assert!(score.floor > 0.0 && is_within, "{metric:?}: {score:?}");
    }
}

#[test]
fn a_sequence_of_one_frame_has_the_error_of_the_frame() {
    let scene = disc_at(0, SPEED);
    let truth = scene.truth([noisy(16, 1), noisy(16, 2)]);
    let instant = instant_of(&scene, [noisy(16, 1), noisy(16, 2)]);
    let output = scene.render(&Blur::IDENTITY, Sampling::CLEAN);
    let single = measure_scores(&output, &scene.frame(), &truth);
    let measured = measure_all(&[instant], &[output.color]);
    let error = single.moving.mse.value();
    assert_eq!(Some(value(&measured, Error)), error);
    for metric in SequenceMetric::ALL.into_iter().skip(1) {
        assert_eq!(measured.scores.get(metric).value(), None, "{metric:?}");
    }
}

#[test]
fn other_sizes_and_counts_are_refused() {
    let (instants, truths) = slide(SPEED);
    let reference = SequenceReference::new(instants, &VIEWING, 30.0);
    let refusal = reference.measure(&truths[1..]).unwrap_err().to_string();
    assert_contains(&refusal, &["4 frames", "5 frames"]);
    let mut small = truths.clone();
    small[2] = small[2].cropped(1);
    let refusal = reference.measure(&small).unwrap_err().to_string();
    assert_contains(&refusal, &["the picture of frame 2 is 94x62"]);
}

#[test]
fn the_guide_names_every_score() {
    let guide = fs::read_to_string(tests::root().join("docs/sequences.md")).unwrap();
    for metric in SequenceMetric::ALL {
        let heading = format!("| `{}` |", metric.row().name);
        assert!(guide.contains(&heading), "it lacks {heading}");
    }
}
