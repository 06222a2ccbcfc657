//! Golan's add-on for Godot, and the engine's proposal after it, 2026.

use super::{Steady, Tap, nearest};
use crate::vector::{length, scaled};

/// Places the taps on both sides: along the pixel's own motion, and over them those along the longest motion near, which tiles of the
/// add-on hold in whole pixels.
pub fn place_taps(preset: &str, steady: &Steady, noise: f64) -> Vec<Tap> {
    let (cut, is_engine) = match preset {
        "engine" => (40.0, true),
        _ => (64.0, false),
    };
    let own = scaled(
        steady.trail(),
        (cut / length(steady.trail())).min(1.0) / 2.0,
    );
    let near = match is_engine {
        true => own,
        false => scaled(scaled(own, 2.0).map(f64::trunc), 0.5),
    };
    let covered = match preset {
        "addon" => (length(near) / length(own)).sqrt(),
        _ => 1.0,
    };
    let parts = (0..8).flat_map(|i| {
        let [ahead, behind] = match is_engine {
            true => [8.0 - f64::from(i) - noise; 2],
            false => [f64::from(i) + noise, f64::from(i + 1) - noise],
        };
        [ahead / 8.0, -behind / 8.0]
    });
    let tap = |offset, weight| Tap { offset, weight };
    let taps = |part| {
        [(own, 1.0 - covered), (near, covered)]
            .map(|(path, weight)| tap(scaled(path, part).map(nearest), weight))
    };
    parts.flat_map(taps).collect()
}
