//! Reconstruction of McGuire et al. 2012 in the paper's notation: Z is negative into the screen.

use tests::kernels::{cone, cylinder};
use tests::vector::{Vec2, length, scaled};

use super::NOISE;
use super::tiles::vector;
use crate::reference::{Run, noise};

/// The paper's epsilon, in pixels.
const EPSILON: f64 = 1e-4;

/// Computes a pixel from the GPU's neighbourhoods. Distances are between pixels, so noise cannot
/// change a weight.
pub fn reconstruct(run: &Run, pixel: [i64; 2]) -> Option<([f64; 3], f64)> {
    let largest = vector(run.texture("neighborhoods"), super::tiles(run).of(pixel));
    let limit = EPSILON + 0.5;
    if (length(largest) - limit).abs() < 1e-5 {
        return None;
    }
    if length(largest) <= limit {
        return Some((super::color(run, pixel), 0.0));
    }
    let samples = run.integer("samples");
    let (jitter, uncertainty) = match run.choice("jitter").as_str() {
        "none" => (0.0, 0.0),
        _ => (noise(pixel, 0.0, NOISE)? - 0.5, NOISE),
    };
    let radius = |pixel: [i64; 2]| length(super::motion(run, pixel)).max(0.5);
    let z = |pixel: [i64; 2]| -super::depth(run, pixel);
    let mut weight = 1.0 / radius(pixel);
    let mut sum = super::color(run, pixel).map(|component| component * weight);
    for i in 0..samples {
        if 2 * i == samples - 1 {
            continue;
        }
        let step = 2.0 / (samples as f64 + 1.0);
        let t = -1.0 + step * (i as f64 + jitter + 1.0);
        let misplaced = 1e-4 + uncertainty * step * length(largest);
        let offset = round_clearly(scaled(largest, t), misplaced)?;
        let distance = length(offset.map(|component| component as f64));
        let tap = on_image(run, pixel, offset);
        let f = soft_depth_compare(z(pixel), z(tap), run.real("soft_extent"));
        let b = soft_depth_compare(z(tap), z(pixel), run.real("soft_extent"));
        let a = f * cone(distance, radius(tap))
            + b * cone(distance, radius(pixel))
            + 2.0 * cylinder(distance, radius(tap)) * cylinder(distance, radius(pixel));
        weight += a;
        let color = super::color(run, tap);
        sum = [0, 1, 2].map(|channel| sum[channel] + a * color[channel]);
    }
    Some((sum.map(|component| component / weight), 0.0))
}

/// Rounds to the nearest whole pixel; none if `margin` decides.
fn round_clearly(offset: Vec2, margin: f64) -> Option<[i64; 2]> {
    let clear = offset
        .iter()
        .all(|component| (component - component.floor() - 0.5).abs() > margin);
    clear.then(|| offset.map(|component| (component + 0.5).floor() as i64))
}

/// Returns the pixel at an offset, clamped to the image.
pub fn on_image(run: &Run, pixel: [i64; 2], offset: [i64; 2]) -> [i64; 2] {
    [0, 1].map(|axis| (pixel[axis] + offset[axis]).clamp(0, run.size()[axis] - 1))
}

fn soft_depth_compare(za: f64, zb: f64, extent: f64) -> f64 {
    (1.0 - (za - zb) / extent).clamp(0.0, 1.0)
}
