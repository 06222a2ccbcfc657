//! KinoMotion, 2016.

use super::{Steady, Tap, bilinear, tap_here};
use crate::vector::{length, scaled};

/// Returns the taps of its presets.
pub fn place_taps(preset: &str, steady: &Steady, noise: f64) -> Vec<Tap> {
    let motion = packed(steady);
    let reach = length(motion);
    if reach < 2.0 {
        return vec![tap_here(1.0)];
    }
    let most: f64 = match preset {
        "default" => 4.0,
        "ppv2" | "mended" => 5.0,
        _ => panic!("say here how many taps {preset} has"),
    };
    let pairs = most.min(0.5 * reach).floor();
    let step = 1.0 / pairs;
    let shift = (noise - 0.5) * step;
    let window = |along: f64| if preset == "mended" { 1.0 } else { 1.2 - along };
    let mut taps = vec![tap_here(window(0.0) * step / (2.0 * reach))];
    for pair in 0..pairs as u32 {
        let along = 1.0 - (f64::from(pair) + 0.5) * step;
        for place in [along + shift, -along + shift] {
            // The weight is 1 up to the last pixel, times a window that may fall to a sixth.
            let arrives = (reach - reach * place.abs()).clamp(0.0, 1.0);
            let weight = arrives / reach * window(along);
            taps.extend(bilinear(scaled(motion, place), weight));
        }
    }
    taps
}

/// Returns half the motion in pixels, cut at 5 % of the rows, after packing in 10 bits per axis.
fn packed(steady: &Steady) -> [f64; 2] {
    let radius = (f64::from(steady.size[1]) * 5.0 / 100.0).floor().max(1.0);
    let half = scaled(steady.trail(), 0.5);
    let cut = scaled(half, (radius / length(half).max(1e-6)).min(1.0));
    cut.map(|component| {
        let bits = ((0.5 * component / radius + 0.5) * 1023.0 + 0.5).floor();
        (2.0 * bits / 1023.0 - 1.0) * radius
    })
}
