//! Places of the smears at the panel's front and back edge.
//!
//! Each smear is measured twice: by the light that the panel adds to the wall, and by the light that it loses to the
//! wall.

use frame::{Alignment, Plane};
use tests::kernels::{along_motion, expected_ramp, place_taps};

use super::fits;
use super::outcome::{ANGLES, OUTCOMES, Outcome};
use super::panel::{HALF_PANEL, HEIGHT, Shot, TRUTHS, WIDTH};

/// Amounts of light along the motion, in pixels' worth of the panel.
#[derive(Clone, Copy, Debug)]
struct Light {
    behind: f64,
    lost_at_back: f64,
    lost_at_front: f64,
    ahead: f64,
}

impl Light {
    fn measure(outcome: &Outcome) -> Self {
        Self::of(outcome.shot(), &outcome.matte)
    }

    fn of(shot: &Shot, blurred: &Plane) -> Self {
        let before = shot.profile(shot.matte());
        let after = shot.profile(blurred);
        let sum = |from: f64, to: f64| {
            let pairs = before.iter().zip(&after);
            pairs
                .filter(|((position, _), _)| (from..to).contains(position))
                .map(|((_, before), (_, after))| after - before)
                .sum::<f64>()
        };
        let far = f64::INFINITY;
        Self {
            behind: sum(-far, -HALF_PANEL),
            lost_at_back: -sum(-HALF_PANEL, 0.0),
            lost_at_front: -sum(0.0, HALF_PANEL),
            ahead: sum(HALF_PANEL, far),
        }
    }

    fn all(self) -> [f64; 4] {
        [
            self.behind,
            self.lost_at_back,
            self.lost_at_front,
            self.ahead,
        ]
    }
}

/// Returns how far the taps lie ahead of their pixel and behind it, on average over all taps: the panel loses as much
/// of itself to the wall there.
fn average_reach(outcome: &Outcome) -> [f64; 2] {
    let steady = outcome.shot().steady();
    let steps = 100;
    let mut reach = [0.0; 2];
    for step in 0..steps {
        let noise = (f64::from(step) + 0.5) / f64::from(steps);
        let taps = place_taps(&outcome.filter, &outcome.preset, &steady, noise);
        let total: f64 = taps.iter().map(|tap| tap.weight).sum();
        for tap in taps {
            let along = along_motion(&steady, tap.offset);
            reach[0] += along.max(0.0) * tap.weight / total / f64::from(steps);
            reach[1] += (-along).max(0.0) * tap.weight / total / f64::from(steps);
        }
    }
    reach
}

/// Returns whether a smear of this many pixels behind the panel lies within the picture.
fn on_picture(shot: &Shot, smear: f64) -> bool {
    let [right, down] = shot.direction().to_array().map(f64::abs);
    (HALF_PANEL + smear) * right < 0.5 * f64::from(WIDTH)
        && (HALF_PANEL + smear) * down < 0.5 * f64::from(HEIGHT)
}

/// Returns the expected light behind, lost at the back, lost at the front, and ahead; none where only the filter's own
/// references know it.
fn expected_light(outcome: &Outcome) -> [Option<f64>; 4] {
    let [forward, backward] = average_reach(outcome);
    match (outcome.filter.as_str(), outcome.preset.as_str()) {
        ("identity" | "camera_gather" | "babylon_screen", _) => [Some(0.0); 4],
        // Nothing leaves the silhouette; within it, all taps count.
        ("velocity_gather" | "bevy" | "three" | "babylon" | "realism_effects", _) => {
            [Some(0.0), Some(backward), Some(forward), Some(0.0)]
        }
        // The light that the panel loses at its front lies behind it.
        ("jump_flood" | "jump_flood_packed", "corrected") => {
            [Some(forward), Some(0.0), Some(forward), Some(0.0)]
        }
        // The light behind depends on which steps of the dilation meet the panel.
        ("jump_flood" | "jump_flood_packed", _) => [None, Some(0.0), Some(forward), Some(0.0)],
        // The slow wall takes most of its own colour, and the panel takes none of the wall's.
        ("mcguire" | "guertin", _) => [None, Some(0.0), Some(0.0), None],
        // For motion up by 8 pixels, Unity's walk misses the tile above.
        ("jimenez", "hdrp" | "hdrp_mirrored") if outcome.shot().degrees == 90.0 => {
            [Some(forward), Some(backward), Some(forward), None]
        }
        // Tiles of 20 and 32 pixels do not carry smears ten times as long.
        ("jimenez", "o3de" | "wicked") => [None, Some(backward), Some(forward), None],
        _ => [Some(forward), Some(backward), Some(forward), Some(backward)],
    }
}

#[test]
fn the_truth_leaves_half_its_smear_behind_or_an_eighth_on_each_side_of_both_edges() {
    let (shot, truths) = &*TRUTHS;
    for (alignment, truth) in truths {
        let expected = match alignment {
            Alignment::Trailing => [0.5, 0.0, 0.5, 0.0],
            _ => [0.125; 4],
        };
        let found = Light::of(shot, truth).all();
        for (found, expected) in found.iter().zip(expected) {
            // The panel's edge lies within a pixel, and the tent is 2 wide.
            assert!(
                (found - expected * shot.speed).abs() < 0.5,
                "{found} {expected}"
            );
        }
    }
}

#[test]
fn light_lies_where_each_filter_s_taps_put_it() {
    println!("behind, lost at back, lost at front, ahead, of the length; at {ANGLES:?} degrees");
    let (mut wrong, mut compared) = (Vec::new(), 0);
    for row in OUTCOMES.chunks(ANGLES.len()) {
        let mut cells = Vec::new();
        for outcome in row {
            let (shot, found) = (outcome.shot(), Light::measure(outcome).all());
            let steady = shot.steady();
            let smear = expected_ramp(&outcome.filter, &outcome.preset, &steady).length;
            if !fits(outcome) || !on_picture(shot, smear) {
                cells.push("longer than panel or wall".to_owned());
                continue;
            }
            let shares = found.map(|light| format!("{:.2}", light / shot.speed));
            cells.push(shares.join(" "));
            for (found, expected) in found.into_iter().zip(expected_light(outcome)) {
                let Some(expected) = expected else { continue };
                // The panel's edge lies within a pixel, and the tent is 2 wide. The steps of some filters are a
                // sixteenth.
                let tolerance = 0.5 + 0.02 * shot.speed;
                if (found - expected).abs() > tolerance {
                    wrong.push(format!(
                        "{}: {found} instead of {expected}",
                        outcome.describe()
                    ));
                }
                compared += 1;
            }
        }
        let name = format!("{} {}", row[0].filter, row[0].preset);
        let speed = row[0].shot().speed;
        println!("{name:<28} {speed:>2} px   {}", cells.join("   "));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    println!("{compared} compared");
}

#[test]
fn a_mover_stays_opaque_and_grows_under_cones_and_cylinders() {
    let tile_filters = OUTCOMES.iter().filter(|outcome| {
        let longest_of_the_uncut =
            outcome.shot().speed == 24.0 && outcome.preset != "motion_blur_demo";
        longest_of_the_uncut && ["mcguire", "guertin"].contains(&outcome.filter.as_str())
    });
    for outcome in tile_filters {
        let light = Light::measure(outcome);
        let share = |light: f64| light / outcome.shot().speed;
        // The truth has an eighth in all four places: its smear takes as much from the panel as it gives to the wall.
        let grown = match outcome.preset.as_str() {
            "tuned" => 0.11..0.125,
            _ => 0.13..0.25,
        };
        assert!(
            grown.contains(&share(light.behind)),
            "{}: {light:?}",
            outcome.describe()
        );
        assert!(
            share(light.lost_at_back) < 0.02,
            "{}: {light:?}",
            outcome.describe()
        );
    }
}

#[test]
fn the_published_flood_leaves_no_trail_behind_slow_movers() {
    let slow = OUTCOMES.iter().filter(|outcome| {
        let published = ["paper", "july_2024"].contains(&outcome.preset.as_str());
        let flood = outcome.filter.starts_with("jump_flood") && published;
        flood && outcome.shot().speed < 8.0
    });
    let mut tried = 0;
    for outcome in slow {
        let light = Light::measure(outcome);
        // The tent spreads this much.
        assert!(light.behind < 0.1, "{}: {light:?}", outcome.describe());
        tried += 1;
    }
    assert_eq!(tried, 4 * ANGLES.len());
}
