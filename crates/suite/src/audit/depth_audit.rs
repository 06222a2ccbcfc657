//! Audit of depth.

use frame::{FAR_DEPTH, Plane};
use serde::Serialize;
use tracer::{PointLayers, Scene};

use super::cause::{Cause, Defect};
use super::clear_pixels::ClearPixels;

/// Relative difference of depths that are taken for equal.
const TOLERANCE: f64 = 0.01;
/// Part of the pixels that must be right, or that a cause must explain.
const LEAST_EXPLAINED: f64 = 0.95;

/// Agreement of an engine's depth with the scene's.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DepthAudit {
    /// Number of pixels compared.
    pub pixels: usize,
    /// Median of the relative difference.
    pub median: f64,
    /// 95th percentile of the relative difference.
    pub p95: f64,
    /// Part of the pixels within 1 %.
    pub agreeing: f64,
}

/// Tells whether two depths are within 1 %, or both the background's.
pub fn is_close_depth(found: f32, expected: f32) -> bool {
    relative_difference(found, expected) <= TOLERANCE
}

/// Compares depth on clear pixels; returns what is wrong as well, if anything is.
pub fn audit_depth(
    found: &Plane,
    right: &PointLayers,
    regions: &[ClearPixels],
    scene: &Scene,
) -> (DepthAudit, Option<Defect>) {
    let pixels: Vec<usize> = regions
        .iter()
        .flat_map(|region| region.pixels.iter().copied())
        .collect();
    let pair = |at: usize| (found.pixels[at], right.depth.pixels[at]);
    let mut differences: Vec<f64> = (pixels.iter())
        .map(|at| relative_difference(pair(*at).0, pair(*at).1))
        .collect();
    differences.sort_by(f64::total_cmp);
    let at_part = |part: f64| {
        let last = differences.len().saturating_sub(1);
        differences
            .get((part * last as f64).round() as usize)
            .copied()
            .unwrap_or(0.0)
    };
    let share = |explains: &dyn Fn(usize) -> bool| {
        pixels.iter().filter(|at| explains(**at)).count() as f64 / pixels.len().max(1) as f64
    };
    let audit = DepthAudit {
        pixels: pixels.len(),
        median: at_part(0.5),
        p95: at_part(0.95),
        agreeing: share(&|at| is_close_depth(pair(at).0, pair(at).1)),
    };
    if audit.agreeing >= LEAST_EXPLAINED {
        return (audit, None);
    }
    let surfaces: Vec<usize> = (pixels.iter().copied())
        .filter(|at| !is_far(pair(*at).1))
        .collect();
    let ray_length = |at: usize| {
        let (x, y) = (at % found.width as usize, at / found.width as usize);
        let view = scene.camera.view(0.0, found.width, found.height);
        let ray = view.ray(x as f64 + 0.5, y as f64 + 0.5);
        ray.direction.length() / view.depth(ray.at(1.0))
    };
    let scale = median(
        surfaces
            .iter()
            .map(|at| f64::from(pair(*at).0 / pair(*at).1)),
    );
    // A projection with other planes changes 1 / depth by a factor and a constant.
    let planes = fit_line(surfaces.iter().map(|at| {
        let (found, expected) = pair(*at);
        [1.0 / f64::from(expected), 1.0 / f64::from(found)]
    }));
    let behind =
        median((pixels.iter().filter(|at| is_far(pair(**at).1))).map(|at| f64::from(pair(*at).0)));
    let is_background_alone =
        share(&|at| is_far(pair(at).1) || is_close_depth(pair(at).0, pair(at).1));
    let candidates = [
        (
            Cause::DepthOfBackground(behind),
            if behind.is_finite() {
                is_background_alone
            } else {
                0.0
            },
        ),
        (
            Cause::DepthAlongRay,
            share(&|at| {
                let (found, expected) = pair(at);
                is_far(expected)
                    || is_close_depth(found, (f64::from(expected) * ray_length(at)) as f32)
            }),
        ),
        (
            Cause::DepthScale(scale),
            share(&|at| {
                let (found, expected) = pair(at);
                is_far(expected) || is_close_depth(found, (f64::from(expected) * scale) as f32)
            }),
        ),
        (
            Cause::DepthPlanes(1.0 / planes[0]),
            share(&|at| {
                let (found, expected) = pair(at);
                let fitted = 1.0 / (planes[0] / f64::from(expected) + planes[1]);
                is_far(expected) || is_close_depth(found, fitted as f32)
            }),
        ),
    ];
    let best = (candidates.into_iter()).find(|(_, explained)| *explained >= LEAST_EXPLAINED);
    let (cause, explained) = best.unwrap_or((Cause::Unknown, 0.0));
    let mut finding = Defect::new(None, cause, Vec::new(), explained);
    if cause == Cause::Unknown {
        finding.text = format!(
            "depth differs by more than 1 % at {:.0} % of the pixels, in no known way; check the camera, and depth, near and far \
             in the convention",
            100.0 * (1.0 - audit.agreeing)
        );
    }
    (audit, Some(finding))
}

fn is_far(depth: f32) -> bool {
    depth >= 0.1 * FAR_DEPTH
}

fn relative_difference(found: f32, expected: f32) -> f64 {
    match (is_far(found), is_far(expected)) {
        (true, true) => 0.0,
        (false, false) => f64::from((found - expected).abs() / expected),
        _ => 1.0,
    }
}

/// Returns the median; NaN of nothing.
pub fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Fits slope and constant by least squares.
fn fit_line(points: impl Iterator<Item = [f64; 2]> + Clone) -> [f64; 2] {
    let count = points.clone().count() as f64;
    let mean = |axis: usize| points.clone().map(|point| point[axis]).sum::<f64>() / count;
    let means = [mean(0), mean(1)];
    let product = |a: usize, b: usize| -> f64 {
        points
            .clone()
            .map(|point| (point[a] - means[a]) * (point[b] - means[b]))
            .sum()
    };
    let slope = product(0, 1) / product(0, 0);
    [slope, means[1] - slope * means[0]]
}
