//! Dagor Engine, 2026.

use super::tiles::{cone, cylinder};
use super::{Steady, Tap, bilinear, tap_here};
use crate::vector::{Vec2, direction, length, scaled};

/// Side of a tile, in pixels.
const TILE: f64 = 16.0;

/// Returns the taps of a pixel in a band of 33 pixels along the motion, through the middle of the
/// picture: smears are shortest there.
pub fn place_taps(preset: &str, steady: &Steady, noise: f64) -> Vec<Tap> {
    let strength = match preset {
        "default" => 0.6,
        "mended" => 0.0,
        _ => panic!("say here how strong the vignette of {preset} is"),
    };
    let half = scaled(steady.trail(), 0.5);
    let half = scaled(half, (32.0 / length(half)).min(1.0));
    let shortened = |from_middle: Vec2| {
        let place = [0, 1].map(|axis| from_middle[axis] / (0.5 * steady.size()[axis]));
        let vignette = (length(place).powi(2) + 1.0 - strength).clamp(0.0, 1.0);
        scaled(half, vignette.powi(2))
    };
    // Together they fill the band and the noise of both axes.
    let [aside, other_noise] = [617.0 * noise, 31.0 * noise].map(f64::fract);
    let [x, y] = direction(half, [1.0, 0.0]);
    let from_middle = scaled([-y, x], 33.0 * (aside - 0.5));
    let farthest =
        |noises, tiles| shortened(farthest_near(from_middle, noises, tiles, steady.size()));
    let motion = shortened(from_middle);
    let longest = farthest([noise, other_noise], 1.0);
    // Threads of a group share their count, and noise leads some of them to the next tile.
    let asked = length(farthest([0.5, 0.5], 2.0)) / 32.0 * 4.0;
    let count = 4 * (asked.ceil() as u32).clamp(1, 4);
    gather(motion, longest, count, noise)
}

/// Returns the place farthest from the picture's middle in the tiles around a pixel; noise moves
/// the pixel by a quarter of a tile.
fn farthest_near(from_middle: Vec2, noises: Vec2, tiles: f64, size: Vec2) -> Vec2 {
    [0, 1].map(|axis| {
        let middle = 0.5 * size[axis];
        let place = middle + from_middle[axis] + (0.5 * noises[axis] - 0.25) * TILE;
        let first = (place / TILE).floor() - tiles;
        let ends = [0.5, (2.0 * tiles + 1.0) * TILE - 0.5].map(|end| first * TILE + end - middle);
        ends[0].abs().max(ends[1].abs())
    })
}

/// Places taps at equal depths, by turns along the pixel's own motion and the longest one near.
fn gather(motion: Vec2, longest: Vec2, count: u32, noise: f64) -> Vec<Tap> {
    let reach = length(motion).max(0.5);
    let has_direction = |motion: Vec2| f64::from(u8::from(length(motion) >= 0.5));
    // A slow pixel's own direction is mixed with the one across.
    let trust = ((reach - 0.5) / 1.5).clamp(0.0, 1.0);
    let aligned = trust / length([trust, 1.0 - trust]);
    let mut taps = vec![tap_here(f64::from(count) / (40.0 * reach))];
    for i in 0..count {
        let (pair, is_ahead) = (i / 2, i % 2 == 0);
        let path = if pair % 2 == 0 { motion } else { longest };
        let part = if is_ahead { noise } else { 1.0 - noise };
        let place = 2.0 * (f64::from(pair) + part) / f64::from(count);
        let distance = place * length(path).max(0.5);
        let tap_reach = length(motion).max(1e-9);
        let over = 0.5 * cone(distance, tap_reach);
        let behind = 0.5 * cone(distance, reach) * aligned;
        let both = cylinder(distance, tap_reach.min(reach));
        let weight = over.max(behind).max(both) * has_direction(path);
        let offset = scaled(path, if is_ahead { place } else { -place });
        taps.extend(bilinear(offset, weight));
    }
    taps
}
