//! Golan's add-on for Godot, and the engine's proposal after it, 2026.

use super::{Steady, Tap, nearest};
use crate::vector::{length, scaled};

/// Places the taps on both sides: along the pixel's own motion, and over them those along the
/// longest motion near, which tiles of the add-on hold in whole pixels.
pub fn place_taps(preset: &str, steady: &Steady, noise: f64) -> Vec<Tap> {
    let cut = match preset {
        "addon" => 64.0,
        "engine" => 40.0,
        "mended" => 128.0,
        _ => panic!("say here how long the trails of {preset} are"),
    };
    let trail = scaled(
        steady.trail(),
        (cut / length(steady.trail())).min(1.0) / 2.0,
    );
    let near = match preset {
        // As 16 bits hold them, 11.999 are 12.
        "addon" | "mended" => scaled(
            scaled(trail, 2.0).map(|part| f64::from((part as f32).trunc())),
            0.5,
        ),
        _ => trail,
    };
    let covered = (length(near) / length(trail)).sqrt();
    let parts = (0..8).flat_map(|i| {
        let [ahead, behind] = match preset {
            "engine" => [8.0 - f64::from(i) - noise; 2],
            _ => [f64::from(i) + noise, f64::from(i + 1) - noise],
        };
        [ahead / 8.0, -behind / 8.0]
    });
    let tap = |offset, weight| Tap { offset, weight };
    let taps = |part| {
        [(trail, 1.0 - covered), (near, covered)]
            .map(|(path, weight)| tap(scaled(path, part).map(nearest), weight))
    };
    parts.flat_map(taps).collect()
}
