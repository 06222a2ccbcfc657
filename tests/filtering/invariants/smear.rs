//! Smears next to a mover.

use filters::Blur;
use frame::{Alignment, FAR_DEPTH, Raster, Reprojection};
use tests::near::assert_within;
use tests::presets::{every_preset, preset_name};
use tests::ready_blur;

use super::FRAME_INDEX;
use crate::fields::Field;

const EDGE: u32 = 120;
const ROWS: u32 = 31;

/// Makes a white wall left or right of an edge that moves right, in front of a black sky.
fn wall(left: bool, speed: f32) -> Field {
    let (width, height) = (2 * EDGE, ROWS);
    let wall = |x: u32| (x < EDGE) == left;
    // A camera move that moves everything at the wall's depth this way.
    let rows = [
        [1.0, 0.0, 0.0, -2.0 * f64::from(speed)],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
    ];
    Field {
        color: Raster::from_fn(width, height, |x, _| [f32::from(wall(x)); 3]),
        velocity: Raster::from_fn(width, height, |x, _| [f32::from(wall(x)) * speed, 0.0]),
        depth: Raster::from_fn(width, height, |x, _| if wall(x) { 2.0 } else { FAR_DEPTH }),
        reprojection: Some(Reprojection { rows }),
        exposure: 1.0,
    }
}

/// Measures the light of a white wall, with its edge at the left or right and moving right over
/// black, on the black.
fn light_beside_a_wall(blur: &mut Blur, left: bool) -> f64 {
    let output = wall(left, 24.0).blur(blur, FRAME_INDEX);
    let black = if left { EDGE..output.width } else { 0..EDGE };
    black.map(|x| f64::from(output.at(x, 15)[0])).sum()
}

#[test]
fn filters_smear_beyond_a_mover_where_they_carry_motion_and_only_there() {
    for (filter, settings) in every_preset() {
        println!("{}", preset_name(&filter, &settings));
        let mut blur = ready_blur(&filter, &settings, (2 * EDGE, ROWS));
        let [ahead, behind] = [true, false].map(|left| light_beside_a_wall(&mut blur, left));
        // The wall has not touched anything ahead of its edge.
        if filter.alignment == Alignment::Trailing {
            assert_eq!(ahead, 0.0);
        }
        // An even trail of 24 pixels leaves the light of 12 behind the wall; a centred one leaves
        // the light of 3 on either side.
        match (filter.name.as_str(), settings.preset.as_str()) {
            ("jump_flood" | "jump_flood_packed", _) => assert_within(behind, 6.0..),
            ("mcguire" | "guertin" | "jimenez" | "blender" | "godot", _) | ("dagor", "mended") => {
                assert_within(ahead.min(behind), 1.5..);
            }
            // Smears are 4 pixels long in the middle, and taps along the longest motion near step
            // over them.
            ("dagor", _) => assert_eq!(ahead.min(behind), 0.0),
            // Of 31 rows, a tile has one pixel, and half-motions of three taps end after two: 2 to
            // 4 of 7 colours.
            ("vort", _) => {
                assert_within(ahead, 0.28..0.58);
                assert_within(behind, 0.28..0.58);
            }
            // The pixel next to the wall has a third of its motion: of 8 pixels, 3.5 lie on the
            // wall.
            ("centred_gather", "smoothed" | "spartan_2024") => {
                assert_within(ahead, 0.35..0.5);
                assert_within(behind, 0.35..0.5);
            }
            _ => assert_eq!(behind, 0.0),
        }
    }
}
