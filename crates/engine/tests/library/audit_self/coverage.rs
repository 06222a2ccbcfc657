//! Coverage of the confidence intervals.

use tests::random::Random;

use super::*;

/// Scenes with objects whose error is known in both directions.
const SCENES: [&str; 4] = ["railing", "fan", "roll", "walker"];
const SEEDS: u64 = 6;
/// Errors that are planted into each pair of frames.
const PLANTED: usize = 4;
/// Range of intervals of 95 % that contain the planted error. Four errors share the noise of a pair
/// of frames, and two axes its blocks: of about 60 independent ones, 95 % have four standard
/// deviations of 11 %.
const COVERED: std::ops::RangeInclusive<f64> = 0.85..=1.0;

#[test]
#[ignore = "prove: 24 pairs of frames"]
fn intervals_contain_planted_errors_as_often_as_they_say() {
    let mut all = 0;
    let mut covered = 0;
    let mut random = Random::new(7);
    for name in SCENES {
        let mut of_scene = [0, 0];
        for seed in 1..=SEEDS {
            let right = draw_frames(name, &TIMES[..2], seed);
            for _ in 0..PLANTED {
                let planted = [0; 2].map(|_| random.real(-0.4, 0.4));
                let mut frames = right.clone();
                for velocity in &mut frames[1].velocity.pixels {
                    *velocity = [0, 1].map(|axis| velocity[axis] + planted[axis]);
                }
                let audit = audit(&frames);
                let errors = audit.pairs[0]
                    .regions
                    .iter()
                    .filter_map(|region| region.error);
                for error in errors.filter(|error| error.only_along.is_none()) {
                    for (axis, planted) in planted.into_iter().enumerate() {
                        let difference = (error.bias[axis] - f64::from(planted)).abs();
                        of_scene[0] += usize::from(difference <= error.half_width[axis]);
                        of_scene[1] += 1;
                    }
                }
            }
        }
        println!(
            "{name}: {} of {} intervals contain the planted error",
            of_scene[0], of_scene[1]
        );
        covered += of_scene[0];
        all += of_scene[1];
    }
    let share = covered as f64 / all as f64;
    println!("all: {:.1} % of {all}", 100.0 * share);
    assert!(COVERED.contains(&share), "{covered} of {all}");
}
