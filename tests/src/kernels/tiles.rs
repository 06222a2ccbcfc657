//! Filters that weight taps by a cone and a cylinder.
//!
//! If everything moves alike at one depth, every tap is both in front and behind: two cones and two
//! cylinders.

use super::{Steady, Tap, bilinear, nearest, tap, tap_here};
use crate::vector::{length, scaled};

/// Places the taps of McGuire et al. 2012, and of two implementations.
pub fn mcguire(preset: &str, steady: &Steady, noise: f64) -> Vec<Tap> {
    let half = scaled(steady.trail(), 0.5);
    match preset {
        // The tuned preset reaches 1.2 times as far and clamps at the ends. The pixel's own
        // direction equals all others.
        "paper" | "tuned" => {
            let is_paper = preset == "paper";
            let (count, spread) = if is_paper { (15, 1.0) } else { (13, 1.2) };
            let half = half_velocity(half, 20.0);
            let radius = length(half);
            let mut taps = vec![tap_here(1.0 / radius)];
            taps.extend((0..count).filter(|i| *i != count / 2).map(|i| {
                let place: f64 = spread * along(i, noise - 0.5, count);
                let offset = scaled(half, place.clamp(-1.0, 1.0)).map(nearest);
                let distance = length(offset);
                let edge = cylinder(distance, radius).powi(2);
                tap(offset, 2.0 * cone(distance, radius) + 2.0 * edge)
            }));
            taps
        }
        // Cut at half a tile. Distances are tiny in its unit, so all taps have equal weight, and
        // the middle one counts.
        "motion_blur_demo" => {
            let half = scaled(half, (10.0 / length(half)).min(1.0));
            let jitter = 2.0 * (noise * std::f64::consts::TAU).sin().rem_euclid(1.0) - 1.0;
            let mut taps = vec![tap_here(1.0 / length(half))];
            taps.extend((0..15).flat_map(|i| bilinear(scaled(half, along(i, jitter, 15)), 4.0)));
            taps
        }
        // 1.2 times as far and clamped at the ends, by distances along the trail, with a hard
        // cylinder.
        "g3d" => {
            let half = half_velocity(half, 64.0);
            let radius = length(half);
            let mut taps = vec![tap_here(27.0 / 40.0 / radius)];
            taps.extend((0..27).filter(|i| *i != 13).map(|i| {
                let place = (1.2 * along(i, noise - 0.5, 27)).clamp(-1.0, 1.0);
                let weight = 2.0 * cone(place.abs() * radius, radius) + 2.0;
                tap(scaled(half, place).map(nearest), weight)
            }));
            taps
        }
        _ => panic!("say here what {preset} averages"),
    }
}

/// Returns the place of a tap between the ends, at -1 and 1.
fn along(i: i32, jitter: f64, count: i32) -> f64 {
    2.0 * (f64::from(i) + jitter + 1.0) / f64::from(count + 1) - 1.0
}

/// Places the taps of Guertin, McGuire and Nowrouzezahrai 2014.
pub fn guertin(steady: &Steady, noise: f64) -> Vec<Tap> {
    let half = half_velocity(scaled(steady.trail(), 0.5), 40.0);
    let radius = length(half);
    let jitter = (2.0 * noise - 1.0) * 0.95 * 27.0 / 35.0;
    // A slow pixel's own direction is mixed with the one across.
    let trust = ((radius - 0.5) / 1.5).clamp(0.0, 1.0);
    let aligned = trust / length([trust, 1.0 - trust]);
    let mut taps = vec![tap_here(35.0 / 40.0 / radius)];
    taps.extend((0..35).map(|i| {
        let place = along(i, jitter, 35);
        let distance = place.abs() * radius;
        let weight = (1.0 + aligned) * cone(distance, radius) + 2.0 * cylinder(distance, radius);
        tap(scaled(half, place).map(f64::trunc), weight)
    }));
    taps
}

/// Clamps half-velocities between half a pixel and `longest`, with the papers' epsilon.
pub fn half_velocity(half: [f64; 2], longest: f64) -> [f64; 2] {
    let speed = length(half);
    scaled(half, speed.clamp(0.5, longest) / (speed + 1e-5))
}

/// Weight that falls evenly to zero at the radius.
pub fn cone(distance: f64, radius: f64) -> f64 {
    (1.0 - distance / radius).clamp(0.0, 1.0)
}

/// Weight of 1 within the radius, and 0 beyond.
pub fn cylinder(distance: f64, radius: f64) -> f64 {
    let part = ((distance - 0.95 * radius) / (0.1 * radius)).clamp(0.0, 1.0);
    1.0 - part * part * (3.0 - 2.0 * part)
}
