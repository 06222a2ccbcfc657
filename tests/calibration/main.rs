//! How long every filter's smear is, against what its preset promises: on the scene `sliding_panel`, at several speeds
//! and angles.

mod outcome;
mod panel;
mod promised;
mod silhouette;

use frame::Alignment;
use outcome::{ANGLES, OUTCOMES, Outcome, SHOTS};
use panel::{HALF_PANEL, TRUTHS};
use promised::promised;
use tests::kernels::{along_motion, expected_ramp, taps};
use tests::ramp::Ramp;

/// Part of a profile on one side of the panel's middle, counted from the panel's edge there.
fn edge(profile: &[(f64, f64)], front: bool) -> Vec<(f64, f64)> {
    let side = if front { 1.0 } else { -1.0 };
    profile
        .iter()
        .filter(|(position, _)| position * side >= 0.0)
        .map(|(position, value)| (position - side * HALF_PANEL, *value))
        .collect()
}

#[test]
fn the_panel_moves_as_fast_and_as_far_as_asked() {
    for shot in SHOTS.iter() {
        let middle = shot.frame.velocity.at(panel::WIDTH / 2, panel::HEIGHT / 2);
        for (found, expected) in middle.iter().zip(shot.steady().velocity) {
            // 32-bit floats of up to 48 pixels.
            assert!((f64::from(*found) - expected).abs() < 1e-4);
        }
    }
}

#[test]
fn the_truth_measures_as_long_as_the_shutter_is_open() {
    let (shot, truths) = &*TRUTHS;
    let instant = shot.profile(shot.matte());
    for (alignment, truth) in truths {
        let truth = shot.profile(truth);
        let middle = match alignment {
            Alignment::Trailing => -0.5 * shot.speed,
            _ => 0.0,
        };
        for front in [true, false] {
            let before = Ramp::of(&edge(&instant, front));
            let found = Ramp::of(&edge(&truth, front)).beyond(before);
            // Noise of 32 samples in a band of 33 pixels, weighed by squares of distances.
            assert!((found.length - shot.speed).abs() < 0.2, "{found:?}");
            assert!((found.middle - middle).abs() < 0.2, "{found:?}");
        }
    }
}

/// Whether the panel is long enough to hold what the taps of a preset make of its middle.
fn fits(outcome: &Outcome) -> bool {
    let steady = outcome.shot().steady();
    let noise = [0.0, 0.25, 0.5, 0.75, 0.999_999];
    let taps = noise
        .into_iter()
        .flat_map(|noise| taps(&outcome.filter, &outcome.preset, &steady, noise));
    let reach = taps
        .map(|tap| along_motion(&steady, tap.offset).abs())
        .fold(0.0, f64::max);
    reach < HALF_PANEL - 3.0
}

/// What the taps of a preset make of an edge painted on the panel. This camera stands still.
fn expected(outcome: &Outcome) -> Ramp {
    match outcome.filter.as_str() {
        "camera_gather" => Ramp {
            length: 0.0,
            middle: 0.0,
        },
        filter => expected_ramp(filter, &outcome.preset, &outcome.shot().steady()),
    }
}

#[test]
fn what_is_painted_on_the_panel_smears_as_far_as_the_taps_of_each_filter_say() {
    println!("measured / true length (promised / true) at {ANGLES:?} degrees");
    let mut wrong = Vec::new();
    let mut measured = 0;
    for row in OUTCOMES.chunks(ANGLES.len()) {
        let mut cells = Vec::new();
        for outcome in row {
            let shot = outcome.shot();
            if !fits(outcome) {
                cells.push("longer than the panel".to_owned());
                continue;
            }
            let before = Ramp::of(&shot.profile(&shot.painted()));
            let found = Ramp::of(&shot.profile(&outcome.painted)).beyond(before);
            let steady = shot.steady();
            let promised = promised(&outcome.filter, &outcome.preset, &steady);
            let expected = expected(outcome);
            cells.push(format!(
                "{:.2} ({:.2})",
                found.length / shot.speed,
                promised / shot.speed
            ));
            let off = [
                found.length - expected.length,
                found.middle - expected.middle,
            ];
            if off.iter().any(|off| off.abs() > 0.2 + 0.01 * shot.speed) {
                wrong.push(format!(
                    "{}: {found:?} instead of {expected:?}",
                    outcome.said()
                ));
            }
            measured += 1;
        }
        let name = format!("{} {}", row[0].filter, row[0].preset);
        println!(
            "{name:<28} {:>2} px  {}",
            row[0].shot().speed,
            cells.join("  ")
        );
    }
    println!("{measured} measured");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
