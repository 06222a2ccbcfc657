//! Jimenez 2014 and the engines that follow it, from their sources.
//!
//! If everything moves alike at one depth, weights are 1, except those of kajiya, which compare in
//! pixels.

use super::{Steady, Tap, at_pixels, bilinear, nearest_tap, on_trail, tap, tap_here};
use crate::vector::{length, scaled};

/// Returns the taps of a preset.
pub fn place_taps(preset: &str, steady: &Steady, noise: f64) -> Vec<Tap> {
    match preset {
        "slides_2014" => slides(steady, noise),
        "hdrp" | "hdrp_mirrored" => hdrp(steady, noise),
        // The exposure's trail extends by half of itself to each side.
        "o3de" => o3de(steady, 0.5, noise),
        // A direction is 128 widths and heights of motion, taken as pixels, and extends 7.5 steps
        // to each side.
        "wicked" => {
            let [width, height] = steady.size();
            let [x, y] = steady.trail();
            wicked([960.0 * x / width, 960.0 * y / height], noise)
        }
        "kajiya" => kajiya(steady, 16.0 / 7.0, noise),
        _ => panic!("say here what {preset} averages"),
    }
}

/// Places eight pairs in the middles of steps, shifted by a quarter of a step to and fro,
/// alternating between pixels.
fn slides(steady: &Steady, noise: f64) -> Vec<Tap> {
    let shift = if noise < 0.5 { -0.25 } else { 0.25 };
    let sides = (0..8).flat_map(|i| [0.5 + f64::from(i) + shift, -0.5 - f64::from(i) - shift]);
    on_trail(scaled(steady.trail(), 0.5 / 8.0), sides)
}

/// Places the taps of MotionBlur.compute of Unity HDRP, 8 samples.
fn hdrp(steady: &Steady, noise: f64) -> Vec<Tap> {
    let [width, height] = steady.size();
    let intensity = 2.0;
    let motion = scaled(steady.trail(), intensity);
    // Lengths are in parts of the picture, times its diagonal.
    let pixels = length([motion[0] / width, motion[1] / height]) * width.hypot(height);
    if pixels <= 2.0 {
        return vec![tap_here(1.0)];
    }
    let motion = scaled(motion, (200.0 / pixels).min(1.0));
    let whole = pixels.min(200.0).floor() as u32;
    let samples = (whole + whole % 2).clamp(2, 8);
    let direction = scaled(motion, 0.5);
    let sides = (0..samples / 2).flat_map(|i| {
        let middle = f64::from(i) + 0.5;
        [-1.0, 1.0].map(|sign| sign * (middle + sign * (noise - 0.5)))
    });
    at_pixels(direction, sides.map(|side| side / f64::from(samples)))
}

/// Places the taps of MotionBlur.azsl of O3DE at quality High, with offsets cut to whole pixels.
fn o3de(steady: &Steady, strength: f64, noise: f64) -> Vec<Tap> {
    let motion = scaled(steady.trail(), strength);
    if length(motion) < 1.0 {
        return vec![tap_here(1.0)];
    }
    let dither = if noise < 0.5 { -0.25 } else { 0.25 };
    let step = scaled(motion, 1.0 / 24.0);
    let offsets = (0..24).map(|i| scaled(step, f64::from(i) + dither).map(f64::trunc));
    let sides = offsets.flat_map(|offset| [offset, scaled(offset, -1.0)]);
    sides.map(|offset| tap(offset, 1.0)).collect()
}

/// Places the taps of motionblurCS.hlsl of Wicked Engine: 16 from end to end of a trail scaled by
/// noise.
fn wicked(half: [f64; 2], noise: f64) -> Vec<Tap> {
    let steps = (0..16).map(|i| f64::from(i) - 7.5);
    at_pixels(half, steps.map(|step| noise * step / 7.5))
}

/// Places the taps of motion_blur.rs of kajiya: the pixel and three steps on each side, of an
/// eighth of half the motion, shifted together.
fn kajiya(steady: &Steady, scale: f64, noise: f64) -> Vec<Tap> {
    // The map of motion of kajiya points back.
    let half = scaled(steady.trail(), -0.5 * scale);
    let shift = 0.5 * ((noise * 32.0).floor() - 15.0) / 15.0;
    let along = |steps: f64| scaled(half, steps / 4.0 * 0.5);
    let mut taps = Vec::new();
    let mut covered = 0.0;
    for i in [1.0, 2.0, 3.0] {
        let distance = length(along(i + shift));
        // Of equal taps, the second takes the first's weight.
        let weight = (length(half) - (distance + 1.0)).clamp(0.0, 1.0) / 7.0;
        covered += 2.0 * weight;
        taps.extend(bilinear(along(i + shift), weight));
        taps.extend(bilinear(along(-i + shift), weight));
    }
    taps.push(tap(nearest_tap(along(shift)).offset, 1.0 - covered));
    taps
}
