//! Lengths of smears that the filters promise.

use std::ops::RangeInclusive;

use tests::kernels::{
    Steady, along_motion, babylon_trail, jump_flood_trail, sees_camera_only, three_trail,
};

/// Returns the promised length of the smear in pixels: the exposure's, times the preset's factor,
/// cut at its reach, unless the preset says otherwise.
pub fn promised_smear(filter: &str, preset: &str, steady: &Steady) -> f64 {
    let [x, y] = steady.trail();
    let trail = x.hypot(y);
    match (filter, preset) {
        ("identity", _) => 0.0,
        // The camera of this scene is still.
        _ if sees_camera_only(filter, preset) => 0.0,
        ("three", _) => along_motion(steady, three_trail(preset, steady)).abs(),
        ("babylon", _) => along_motion(steady, babylon_trail(steady)),
        ("jump_flood" | "jump_flood_packed", preset) => {
            along_motion(steady, jump_flood_trail(preset, steady))
        }
        // Half-velocities are cut at the side of a tile, or at half of it.
        ("mcguire", "paper" | "tuned") => trail.min(2.0 * 20.0),
        ("mcguire", "motion_blur_demo") => trail.min(20.0),
        ("mcguire", "g3d") => trail.min(2.0 * 64.0),
        ("guertin", _) => trail.min(2.0 * 40.0),
        // In the middle of the picture.
        ("dagor", "default") => 0.16 * trail.min(2.0 * 32.0),
        ("dagor", _) => trail.min(2.0 * 32.0),
        ("godot", "engine") => trail.min(40.0),
        ("godot", "addon") => trail.min(2.0 * 32.0),
        ("godot", _) => trail.min(2.0 * 64.0),
        // Two tiles of a 27th of the rows on either side.
        ("vort", _) => trail.min(f64::from(4 * (steady.size[1] / 27))),
        // Whole pixels of 5 % of the rows on either side; nothing below 2.
        ("kino", _) => match (0.05 * f64::from(steady.size[1])).floor() {
            _ if trail < 4.0 => 0.0,
            radius => trail.min(2.0 * radius),
        },
        // Twice the trail, in parts of the picture times its diagonal, is cut at 200 pixels.
        ("jimenez", "hdrp" | "hdrp_mirrored") => {
            let [width, height] = steady.size.map(f64::from);
            let diagonal = width.hypot(height);
            trail * (200.0 / (2.0 * (x / width).hypot(y / height) * diagonal)).min(1.0)
        }
        // 1920 pixels per picture width and height of motion, times noise from 0 to 1.
        ("jimenez", "wicked") => {
            let [width, height] = steady.size.map(f64::from);
            along_motion(steady, [1920.0 * x / width, 1920.0 * y / height])
        }
        _ => trail,
    }
}

/// Returns an edge's spread on the panel according to the filter's text, from 8 pixels on: parts of
/// the promised length, which is `promise` in pixels, in whole hundredths.
pub fn stated_lengths(filter: &str, preset: &str, promise: f64) -> RangeInclusive<f64> {
    match (filter, preset) {
        ("jump_flood" | "jump_flood_packed", "paper") => 1.26..=1.31,
        ("jump_flood" | "jump_flood_packed", "july_2024") => 1.09..=1.12,
        ("mcguire", "paper") => 0.84..=0.91,
        ("mcguire", "motion_blur_demo") => 0.94..=0.97,
        ("mcguire", "g3d") => 1.02..=1.09,
        ("mcguire", "tuned") => 0.86..=1.04,
        ("guertin", _) => 0.65..=0.87,
        ("dagor", "default") => 0.77..=1.11,
        ("godot", "addon" | "mended") => 0.88..=1.025,
        // Where its turn leaves 4 pixels of 8, the pixel grid weighs more.
        ("three", _) if promise < 5.0 => 1.03..=1.09,
        ("three", _) => 1.03..=1.05,
        ("centred_gather", "armory") => 1.07..=1.09,
        ("centred_gather", "spartan_2024") => 0.98..=1.00,
        ("babylon", _) => 0.79..=0.96,
        // Noise adds its own length, on each axis separately: least on diagonals.
        ("realism_effects", _) => 1.29..=1.51,
        ("bevy", "msaa") => 0.955..=1.025,
        ("blender", "eevee" | "eevee_mean") => 0.985..=1.035,
        ("urp", _) => 0.995..=1.045,
        ("kino", "mended") => 0.775..=0.925,
        ("kino", _) => 0.72..=0.78,
        ("jimenez", "hdrp" | "hdrp_mirrored") => 1.00..=1.03,
        ("jimenez", "kajiya") => 0.99..=1.02,
        ("jimenez", "o3de") => 0.72..=0.94,
        ("jimenez", "wicked") => 0.60..=0.63,
        _ => 0.985..=1.025,
    }
}
