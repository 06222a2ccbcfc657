//! Coverage of a pixel by a half-plane, at one time and over a shutter.

use frame::Shutter;
use glam::DVec2;

/// Returns the probability that a sum of independent uniform numbers in `[0, width]` is at most
/// `limit`: a piecewise polynomial (Feller, volume 2, I.9).
fn uniform_sum(limit: f64, widths: &[f64]) -> f64 {
    let widths = widths.iter().copied().filter(|width| *width > 1e-12);
    let widths: Vec<f64> = widths.collect();
    if limit >= widths.iter().sum() {
        return 1.0;
    }
    let degree = widths.len() as i32;
    let sum: f64 = (0..1u32 << widths.len())
        .map(|subset| {
            let numbered = widths.iter().enumerate();
            let taken = numbered.filter(|(index, _)| subset >> index & 1 == 1);
            let shift: f64 = taken.map(|(_, width)| width).sum();
            let sign = (-1.0f64).powi(subset.count_ones() as i32);
            sign * (limit - shift).max(0.0).powi(degree)
        })
        .sum();
    let factorial: f64 = (1..=degree).map(f64::from).product();
    sum / (factorial * widths.iter().product::<f64>())
}

/// Returns the part of pixel x shutter where `normal . p <= offset + speed t`.
pub fn half_plane(pixel: DVec2, normal: DVec2, offset: f64, speed: f64, shutter: Shutter) -> f64 {
    // normal . p - speed t as its smallest value plus three uniform numbers.
    let least = |along: f64, from: f64, to: f64| (along * from).min(along * to);
    let start = least(normal.x, pixel.x, pixel.x + 1.0)
        + least(normal.y, pixel.y, pixel.y + 1.0)
        + least(-speed, shutter.open, shutter.close);
    let moved = speed * shutter.exposure();
    uniform_sum(offset - start, &[normal.x, normal.y, moved].map(f64::abs))
}

/// Returns the part of a pixel where `normal . p <= offset`.
pub fn area(pixel: DVec2, normal: DVec2, offset: f64) -> f64 {
    let least = |along: f64, from: f64| (along * from).min(along * (from + 1.0));
    let start = least(normal.x, pixel.x) + least(normal.y, pixel.y);
    uniform_sum(offset - start, &[normal.x.abs(), normal.y.abs()])
}
