//! Edges in steady motion: side and length of their smear.

use filters::{Filter, Settings};
use frame::{Alignment, FAR_DEPTH, Image, Raster, Reprojection};
use tests::kernels::{Steady, expected_ramp};
use tests::near::{assert_near, assert_within};
use tests::picture::column;
use tests::presets::{every_preset, preset_name};
use tests::ramp::Ramp;

use super::Field;

const EDGE: u32 = 120;

/// Makes a white wall left or right of an edge. With `whole`, the black beside it moves along at the same depth.
fn wall(left: bool, whole: bool, speed: f32, exposure: f64) -> Field {
    let (width, height) = (2 * EDGE, 31);
    let wall = |x: u32| (x < EDGE) == left;
    Field {
        color: Raster::from_fn(width, height, |x, _| [if wall(x) { 1.0 } else { 0.0 }; 3]),
        velocity: Raster::from_fn(width, height, |x, _| {
            [if whole || wall(x) { speed } else { 0.0 }, 0.0]
        }),
        depth: Raster::from_fn(width, height, |x, _| {
            if whole || wall(x) { 2.0 } else { FAR_DEPTH }
        }),
        // A camera move that moves everything at the wall's depth this way.
        reprojection: Reprojection {
            rows: [
                [1.0, 0.0, 0.0, -2.0 * f64::from(speed)],
                [0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, 1.0, 0.0],
            ],
        },
        exposure,
    }
}

/// Measures the edge along the motion.
fn ramp(output: &Image) -> Ramp {
    // Leaves out the border of the image, where filters treat taps in their own ways. The mean over all rows turns noise
    // into its distribution.
    let profile: Vec<(f64, f64)> = (11..output.width - 12)
        .map(|x| (f64::from(x) + 0.5 - f64::from(EDGE), column(output, x)))
        .collect();
    Ramp::of(&profile)
}

#[test]
fn an_edge_in_steady_motion_smears_to_the_right_side_and_length() {
    for (filter, settings) in every_preset() {
        // Two presets smear farther than this wall is wide; tests of their own measure them.
        if filter.name == "jimenez" && ["o3de", "wicked"].contains(&settings.preset.as_str()) {
            continue;
        }
        // Trails of 24 and 12 pixels are below the jump flood's cut of 32, and their halves are below most tiles.
        for (speed, exposure) in [(24.0, 1.0), (24.0, 0.5), (-24.0, 1.0)] {
            println!(
                "{} at {speed} x {exposure}",
                preset_name(&filter, &settings)
            );
            let field = wall(true, true, speed, exposure);
            let found = ramp(&field.blur(&filter, &settings));
            let steady = Steady {
                velocity: [speed.into(), 0.0],
                exposure,
                size: [field.color.width, field.color.height],
            };
            let expected = expected_ramp(&filter.name, &settings.preset, &steady);
            let middle = expected.middle * f64::from(speed.signum());
            // Half a pixel: the edge is between texels, and 8 noisy taps in 31 rows place it to a tenth of a step.
            // Babylon.js reads whole pixels, and rounding decides between two that are equally near.
            let tolerance = match filter.name.starts_with("babylon") {
                true => 1.0,
                false => 0.5,
            };
            assert_near(found.length, expected.length, tolerance);
            assert_near(found.middle, middle, tolerance);
        }
    }
}

/// Measures the light that a white wall, with its edge at the left or right and moving right over black, leaves on the
/// black.
fn light_beside_a_wall(filter: &Filter, settings: &Settings, left: bool) -> f64 {
    let output = wall(left, false, 24.0, 1.0).blur(filter, settings);
    let black = if left { EDGE..output.width } else { 0..EDGE };
    black.map(|x| f64::from(output.at(x, 15)[0])).sum()
}

#[test]
fn filters_smear_beyond_a_mover_where_they_carry_motion_and_only_there() {
    for (filter, settings) in every_preset() {
        println!("{}", preset_name(&filter, &settings));
        let [ahead, behind] =
            [true, false].map(|left| light_beside_a_wall(&filter, &settings, left));
        // The wall has not touched what lies ahead of its edge.
        if filter.alignment == Alignment::Trailing {
            assert_eq!(ahead, 0.0);
        }
        // An even trail of 24 pixels leaves the light of 12 behind the wall; a centred one leaves that of 3 on either
        // side.
        match (filter.name.as_str(), settings.preset.as_str()) {
            ("jump_flood" | "jump_flood_packed", _) => assert_within(behind, 6.0..),
            // Seven sixteenths of that, and noise that shortens most trails.
            ("jimenez", "kajiya" | "wicked_scaled") => assert_within(ahead.min(behind), 0.6..),
            ("mcguire" | "guertin" | "jimenez", _) => assert_within(ahead.min(behind), 1.5..),
            _ => assert_eq!(behind, 0.0),
        }
    }
}

#[test]
fn the_corrected_jump_flood_keeps_trails_that_the_paper_cuts() {
    let filter = Filter::builtin("jump_flood").unwrap();
    let trail_behind = |preset: &str, speed: f32| {
        let settings = filter.settings(Some(preset)).unwrap();
        let field = wall(false, false, speed, 1.0);
        ramp(&field.blur(&filter, &settings)).length
    };
    for speed in [3.0f32, 8.0, 24.0, 48.0, 90.0] {
        // The texel adds one pixel of its own: sqrt(speed^2 + 1). Half a pixel more for the noise.
        assert_near(trail_behind("corrected", speed), speed.hypot(1.0), 0.5);
    }
    // Its smallest step is 8 pixels, which is farther than a slow mover goes.
    assert_eq!(trail_behind("paper", 7.0), 0.0);
    // Its largest step is 32 pixels, and noise may add half as much.
    assert_within(trail_behind("paper", 90.0), ..48.0);
}
