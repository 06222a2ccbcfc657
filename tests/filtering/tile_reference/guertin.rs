//! Reconstruction of Guertin et al. 2014.
//!
//! Depths are compared relative to each other as inverse depths, which are larger for nearer
//! surfaces, as the paper's operands require.

use tests::kernels::{cone, cylinder};
use tests::vector::{Vec2, dot, length, scaled};

use super::NOISE;
use super::mcguire::on_image;
use super::tiles::{texel, vector};
use crate::reference::{Run, noise};

/// Computes a pixel from the GPU's neighbourhoods.
pub fn reconstruct(run: &Run, pixel: [i64; 2]) -> Option<([f64; 3], f64)> {
    let tile = asked_tile(run, pixel)?;
    let color = |noise: f64| color(run, pixel, tile, noise);
    if run.real("jitter") == 0.0 {
        return Some((color(0.5)?, 0.0));
    }
    let noise = noise(pixel, 0.0, NOISE)?;
    let (expected, less, more) = (color(noise)?, color(noise - NOISE)?, color(noise + NOISE)?);
    let differences = (0..3).map(|channel| {
        let [less, more] = [less, more].map(|other| (other[channel] - expected[channel]).abs());
        less.max(more)
    });
    Some((expected, differences.fold(0.0, f64::max)))
}

fn color(run: &Run, pixel: [i64; 2], tile: [i64; 2], noise: f64) -> Option<[f64; 3]> {
    let largest = vector(run.texture("neighborhoods"), tile);
    let variance = texel(run.texture("neighborhoods"), tile)[2];
    if (length(largest) - 0.5001).abs() < 1e-5 {
        return None;
    }
    if length(largest) <= 0.5001 {
        return Some(super::color(run, pixel));
    }
    let motion = super::motion(run, pixel);
    let radius = |vector: Vec2| length(vector).max(0.5);
    let center = center_direction(largest, motion, run.real("own_direction_ramp"));
    let samples = run.integer("samples") as f64;
    let eta_phi = run.real("jitter");
    let jitter = (2.0 * noise - 1.0) * eta_phi / samples;
    let mut weight = samples / (run.real("center_weight_divisor") * radius(motion));
    let mut sum = super::color(run, pixel).map(|component| component * weight);
    for i in 0..run.integer("samples") {
        let step = 2.0 / (samples + 1.0);
        let t = -1.0 + step * (i as f64 + jitter + 1.0);
        let along = if is_own(run, i, variance)? {
            motion
        } else {
            largest
        };
        let misplaced = 1e-4 + 2.0 * NOISE * eta_phi / samples * step * length(along);
        let tap = on_image(run, pixel, truncate_clearly(scaled(along, t), misplaced)?);
        let distance = t.abs() * length(largest);
        let other = super::motion(run, tap);
        let f = z_compare(1.0 / super::depth(run, pixel), 1.0 / super::depth(run, tap));
        let b = z_compare(1.0 / super::depth(run, tap), 1.0 / super::depth(run, pixel));
        let a_weight = dot(center, direction(along)).abs();
        let b_weight = dot(scaled(other, 1.0 / radius(other)), direction(along)).abs();
        let a = f * cone(distance, radius(other)) * b_weight
            + b * cone(distance, radius(motion)) * a_weight
            + 2.0 * cylinder(distance, radius(motion).min(radius(other))) * a_weight.max(b_weight);
        weight += a;
        let color = super::color(run, tap);
        sum = [0, 1, 2].map(|channel| sum[channel] + a * color[channel]);
    }
    Some(sum.map(|component| component / weight))
}

/// Returns the pixel's tile or, by chance, the one across its nearest border.
fn asked_tile(run: &Run, pixel: [i64; 2]) -> Option<[i64; 2]> {
    let tiles = super::tiles(run);
    let tile = tiles.of(pixel);
    let side = tiles.side as f64;
    // Distance from the middle of the tile, in tiles.
    let aside =
        [0, 1].map(|axis| (pixel[axis] as f64 + 0.5 - tile[axis] as f64 * side) / side - 0.5);
    let blend = run.real("tile_blend");
    let distances = aside.map(|component: f64| 0.5 - component.abs());
    if blend == 0.0 || distances.iter().all(|distance| *distance > blend + 1e-4) {
        return Some(tile);
    }
    if (distances[0] - distances[1]).abs() < 1e-5 {
        return None;
    }
    let axis = usize::from(distances[1] < distances[0]);
    let odds = 0.5 * (1.0 - distances[axis] / blend).clamp(0.0, 1.0);
    let drawn = noise(pixel, 37.0, NOISE)?;
    if (drawn - odds).abs() < 2.0 * NOISE {
        return None;
    }
    let mut across = tile;
    if drawn < odds {
        across[axis] += aside[axis].signum() as i64;
    }
    Some([0, 1].map(|axis| across[axis].clamp(0, tiles.count()[axis] - 1)))
}

/// Returns whether tap i follows the pixel's own motion; none if rounding decides.
fn is_own(run: &Run, i: i64, variance: f64) -> Option<bool> {
    if run.choice("split") == "alternate" {
        return Some(i % 2 == 1);
    }
    let taps = [i as f64 * variance, (i + 1) as f64 * variance];
    let clear = taps
        .iter()
        .all(|taps| taps.abs() < 1e-3 || (taps - taps.round()).abs() > 1e-5);
    clear.then(|| taps[1].floor() > taps[0].floor())
}

fn direction(a: Vec2) -> Vec2 {
    tests::vector::direction(a, [0.0; 2])
}

fn center_direction(largest: Vec2, motion: Vec2, gamma: f64) -> Vec2 {
    let along = direction(largest);
    let mut across = [-along[1], along[0]];
    if dot(across, motion) < 0.0 {
        across = scaled(across, -1.0);
    }
    let trust = ((length(motion) - 0.5) / gamma).clamp(0.0, 1.0);
    let motion = direction(motion);
    direction([0, 1].map(|axis| across[axis] + trust * (motion[axis] - across[axis])))
}

/// Truncates towards zero; none if `margin` decides.
fn truncate_clearly(offset: Vec2, margin: f64) -> Option<[i64; 2]> {
    let clear = offset
        .iter()
        .all(|component| component.abs() < 0.5 || (component - component.round()).abs() > margin);
    clear.then(|| offset.map(|component| component.trunc() as i64))
}

fn z_compare(a: f64, b: f64) -> f64 {
    (1.0 - (a - b) / a.min(b)).clamp(0.0, 1.0)
}
