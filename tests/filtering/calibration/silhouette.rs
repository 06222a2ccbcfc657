//! Positions of the smears at the panel's front and back edge.
//!
//! Each smear is measured twice: by the light that the panel adds to the wall, and by the light
//! that it loses to the wall.

use frame::Plane;
use tests::kernels::{along_motion, place_taps, sees_camera_only};

use super::outcome::Outcome;
use tests::panel::Shot;

/// Amounts of light along the motion, in pixels' worth of the panel.
#[derive(Clone, Copy, Debug)]
pub struct Light {
    pub behind: f64,
    lost_at_back: f64,
    lost_at_front: f64,
    ahead: f64,
}

impl Light {
    pub fn of(shot: &Shot, blurred: &Plane) -> Self {
        let before = &shot.matte_profile;
        let after = shot.profile(blurred);
        let sum = |from: f64, to: f64| {
            let pairs = before.iter().zip(&after);
            let part = pairs.filter(|((position, _), _)| (from..to).contains(position));
            part.map(|((_, before), (_, after))| after - before)
                .sum::<f64>()
        };
        let (far, half) = (f64::INFINITY, shot.half_panel());
        Self {
            behind: sum(-far, -half),
            lost_at_back: -sum(-half, 0.0),
            lost_at_front: -sum(0.0, half),
            ahead: sum(half, far),
        }
    }

    pub fn all(self) -> [f64; 4] {
        [
            self.behind,
            self.lost_at_back,
            self.lost_at_front,
            self.ahead,
        ]
    }
}

/// Returns the average distance of taps ahead of their pixel and behind it, over all taps: the
/// panel loses as much of itself to the wall there.
fn average_reach(outcome: &Outcome) -> [f64; 2] {
    let steady = &outcome.steady;
    let steps = 100;
    let mut reach = [0.0; 2];
    for step in 0..steps {
        let noise = (f64::from(step) + 0.5) / f64::from(steps);
        let taps = place_taps(&outcome.filter, &outcome.preset, steady, noise);
        let total: f64 = taps.iter().map(|tap| tap.weight).sum();
        for tap in taps {
            let along = along_motion(steady, tap.offset);
            reach[0] += along.max(0.0) * tap.weight / total / f64::from(steps);
            reach[1] += (-along).max(0.0) * tap.weight / total / f64::from(steps);
        }
    }
    reach
}

/// Returns the expected light behind, lost at the back, lost at the front, and ahead; none if only
/// the filter's own references know it.
fn expected_light(outcome: &Outcome) -> [Option<f64>; 4] {
    let [forward, backward] = average_reach(outcome);
    match (outcome.filter.as_str(), outcome.preset.as_str()) {
        ("identity", _) => [Some(0.0); 4],
        (filter, preset) if sees_camera_only(filter, preset) => [Some(0.0); 4],
        // Nothing leaves the silhouette; within it, all taps count.
        (
            "velocity_gather" | "centred_gather" | "bevy" | "three" | "babylon" | "realism_effects"
            | "urp",
            _,
        ) => [Some(0.0), Some(backward), Some(forward), Some(0.0)],
        // The light that the panel loses at its front is behind it.
        ("jump_flood" | "jump_flood_packed", "corrected") => {
            [Some(forward), Some(0.0), Some(forward), Some(0.0)]
        }
        // The light behind depends on which steps of the dilation reach the panel.
        ("jump_flood" | "jump_flood_packed", _) => [None, Some(0.0), Some(forward), Some(0.0)],
        // The slow wall takes most of its own colour, and the panel takes none of the wall's.
        ("mcguire" | "guertin", _) => [None, Some(0.0), Some(0.0), None],
        // Cones let through part of the wall, and vignettes change the length.
        ("dagor", _) => [None; 4],
        // For motion up by 8 pixels, Unity's walk misses the tile above.
        ("jimenez", "hdrp" | "hdrp_mirrored") if outcome.shot.degrees == 90.0 => {
            [Some(forward), Some(backward), Some(forward), None]
        }
        // Tiles of 20 and 32 pixels do not carry smears ten times as long.
        ("jimenez", "o3de" | "wicked") => [None, Some(backward), Some(forward), None],
        _ => [Some(forward), Some(backward), Some(forward), Some(backward)],
    }
}

/// Compares the light with the preset's taps. Returns what is wrong.
pub fn check_light(outcome: &Outcome, light: Light) -> Option<String> {
    // The smear behind the panel leaves the picture.
    if outcome.shot.half_panel() + outcome.ramp.length >= outcome.shot.to_border() {
        return None;
    }
    let shares = (light.all()).map(|light| format!("{:.2}", light / outcome.shot.speed));
    println!(
        "    behind, lost at back, lost at front, ahead: {}",
        shares.join(" ")
    );
    // The panel's edge is within a pixel, and the tent is 2 wide. The steps of some filters are a
    // sixteenth.
    let tolerance = 0.5 + 0.02 * outcome.shot.speed;
    let pairs = light.all().into_iter().zip(expected_light(outcome));
    let differs = |(actual, expected): (f64, Option<f64>)| {
        expected.is_some_and(|expected| (actual - expected).abs() > tolerance)
    };
    (pairs.clone().any(differs)).then(|| format!("light of {:?}", pairs.collect::<Vec<_>>()))
}

/// Checks the growth of movers under cones and cylinders, and the trail that the published flood
/// leaves behind slow ones. Returns what is wrong.
pub fn check_growth(outcome: &Outcome, light: Light) -> Option<String> {
    let (filter, preset) = (outcome.filter.as_str(), outcome.preset.as_str());
    let speed = outcome.shot.speed * outcome.shot.exposure;
    let is_right = match (filter, preset) {
        ("mcguire", "motion_blur_demo") => true,
        // 24 pixels are the longest that is not cut. The truth has an eighth in all four places:
        // its smear takes as much from the panel as it gives to the wall. A mover stays opaque and
        // grows here.
        ("mcguire" | "guertin", _) if speed == 24.0 => {
            let grown = match preset {
                "tuned" => 0.11..0.125,
                "g3d" => 0.195..0.215,
                _ => 0.13..0.25,
            };
            grown.contains(&(light.behind / speed)) && light.lost_at_back / speed < 0.02
        }
        // The tent spreads this much.
        (_, "paper" | "july_2024") if filter.starts_with("jump_flood") && speed < 8.0 => {
            light.behind < 0.1
        }
        _ => true,
    };
    (!is_right).then(|| format!("grows with {light:?}"))
}
