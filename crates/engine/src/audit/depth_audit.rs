//! Audit of depth: its difference, and defects of the whole or of single objects.

use filters::DepthKind;
use frame::{FAR_DEPTH, Plane, Raster};
use scene::Scene;
use serde::Serialize;
use tracer::PointLayers;

use crate::audit::cause::Cause;
use crate::audit::clear_pixels::{ClearPixels, select_judged};
use crate::audit::defect::{Buffer, Defect, Explanation};
use crate::capture::folder::Capture;
use crate::statistics::{median, percentile};

/// Relative difference of depths that count as equal.
const TOLERANCE: f64 = 0.01;
/// Rounding of a depth buffer between 0 and 1 that is no defect: a few steps of 24 bits.
const BUFFER_ROUNDING: f64 = 1.0 / (1 << 22) as f64;
/// Part of the pixels that must be correct, or that a cause must explain.
pub const LEAST_EXPLAINED: f64 = 0.95;

/// Agreement of an engine's depth with the scene's.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DepthAudit {
    /// Number of pixels compared.
    pub pixels: usize,
    /// Median of the relative difference.
    pub median: f64,
    /// 95th percentile of the relative difference.
    pub p95: f64,
    /// Part of the pixels within 1 %, or within the rounding of the engine's buffer.
    pub agreeing: f64,
}

/// An engine's depth and the scene's.
pub struct DepthPair<'a> {
    /// The engine's, in metres.
    pub buffer: &'a Plane,
    /// The scene's.
    right: &'a PointLayers,
    /// Near plane of a buffer that is not linear: such a buffer is coarse far away, and its planes
    /// may be wrong.
    near: Option<f64>,
}

impl<'a> DepthPair<'a> {
    /// Pairs the depth of a capture with the scene's.
    pub fn of(capture: &'a Capture, right: &'a PointLayers) -> Self {
        let is_linear = capture.convention.depth == DepthKind::Linear;
        Self {
            buffer: &capture.depth,
            right,
            near: capture.convention.near.filter(|_| !is_linear),
        }
    }

    /// Returns whether two depths are within 1 % or within the rounding of the buffer, or both the
    /// background's.
    pub fn is_close(&self, depth: f32, expected: f32) -> bool {
        let steps = (1.0 / f64::from(depth) - 1.0 / f64::from(expected)).abs();
        let is_rounded = |near| steps * near <= BUFFER_ROUNDING;
        relative_difference(depth, expected) <= TOLERANCE || self.near.is_some_and(is_rounded)
    }

    /// Compares depth on clear pixels.
    pub fn compare(&self, regions: &[ClearPixels]) -> DepthAudit {
        let pixels: Vec<usize> = regions
            .iter()
            .flat_map(|region| region.pixels.clone())
            .collect();
        let difference =
            |at: &usize| relative_difference(self.buffer.pixels[*at], self.right.depth.pixels[*at]);
        let mut differences: Vec<f64> = pixels.iter().map(difference).collect();
        differences.sort_by(f64::total_cmp);
        DepthAudit {
            pixels: pixels.len(),
            median: percentile(&differences, 0.5).unwrap_or(0.0),
            p95: percentile(&differences, 0.95).unwrap_or(0.0),
            agreeing: self.share(&pixels, &self.right.depth),
        }
    }

    /// Finds what is wrong on clear pixels. Also returns where depth is right, or wrong by a known
    /// cause.
    pub fn explain(
        &self,
        regions: &[ClearPixels],
        names: &[String],
        scene: &Scene,
    ) -> (Vec<Defect>, Raster<bool>) {
        let right = &self.right.depth;
        let judged = select_judged(regions);
        let is_wrong = |region: &&ClearPixels| self.share(&region.pixels, right) < LEAST_EXPLAINED;
        let wrong: Vec<&ClearPixels> = judged.iter().copied().filter(is_wrong).collect();
        if wrong.is_empty() {
            return (Vec::new(), self.mark(right));
        }
        let along_ray = self.along_ray(scene);
        let all: Vec<usize> = wrong
            .iter()
            .flat_map(|region| region.pixels.clone())
            .collect();
        let is_all = wrong.len() > 1 || wrong.len() == judged.len();
        let of_all = |plane: &Plane| {
            let shares = judged
                .iter()
                .map(|region| self.share(&region.pixels, plane));
            shares.fold(1.0, f64::min)
        };
        let causes = self.list_causes(&all, &along_ray, self.near.is_some());
        if is_all && let Some((explanation, plane)) = find_cause(causes, &of_all) {
            let defect = Defect::new(Buffer::Depth, None, explanation);
            return (vec![defect], self.mark(&plane));
        }
        let (findings, explained) = self.explain_objects(&wrong, names, &along_ray);
        let unknown = findings
            .iter()
            .filter(|defect| defect.explanation.cause == Cause::Unknown)
            .count();
        if findings.len() == 1 || 2 * unknown <= findings.len() {
            return (findings, explained);
        }
        let share = 100.0 * (1.0 - self.share(&all, right));
        let text = format!(
            "it differs by more than 1 % at {share:.0} % of the pixels of {} objects; check the camera, and depth, near and far in \
             the convention",
            findings.len()
        );
        let unknown = Explanation::by(Cause::Unknown, 0.0);
        let defect = Defect::new(Buffer::Depth, None, unknown).with(&text);
        (vec![defect], explained)
    }

    /// Finds a cause for each object with wrong depth.
    fn explain_objects(
        &self,
        wrong: &[&ClearPixels],
        names: &[String],
        along_ray: &Plane,
    ) -> (Vec<Defect>, Raster<bool>) {
        let mut explained = self.mark(&self.right.depth);
        let findings = wrong.iter().map(|region| {
            // A projection's planes apply to every object.
            let causes = self.list_causes(&region.pixels, along_ray, false);
            let fit = find_cause(causes, &|plane| self.share(&region.pixels, plane));
            if let Some((_, plane)) = &fit {
                let ids = self.right.object_id.pixels.iter();
                let marks = self.mark(plane).pixels;
                let pixels = explained.pixels.iter_mut().zip(ids.zip(marks));
                pixels
                    .filter(|(_, (id, _))| **id == region.object)
                    .for_each(|(explained, (_, mark))| *explained = mark);
            }
            let unknown = Explanation::by(Cause::Unknown, 0.0);
            let explanation = fit.map_or(unknown, |(explanation, _)| explanation);
            let is_background = matches!(explanation.cause, Cause::DepthOfBackground(_));
            let object = (!is_background).then(|| names[region.object as usize].as_str());
            Defect::new(Buffer::Depth, object, explanation)
        });
        (findings.collect(), explained)
    }

    /// Lists causes, fitted to some pixels, with each one's depth; the simplest first. NaN allows
    /// any depth.
    fn list_causes(
        &self,
        pixels: &[usize],
        along_ray: &Plane,
        has_planes: bool,
    ) -> Vec<(Cause, Plane)> {
        let right = &self.right.depth;
        let pairs = (pixels.iter()).map(|at| [self.buffer.pixels[*at], right.pixels[*at]]);
        let (background, surfaces): (Vec<_>, Vec<_>) =
            (pairs.map(|pair| pair.map(f64::from))).partition(|[_, right]| is_far(*right as f32));
        let metres = median(background.iter().map(|[depth, _]| *depth));
        let of_surfaces = |depth: &dyn Fn(f64) -> f64| {
            right.map(|right| {
                if is_far(*right) {
                    f32::NAN
                } else {
                    depth(f64::from(*right)) as f32
                }
            })
        };
        let mut causes = Vec::new();
        if metres.is_finite() {
            let plane = right.map(|right| {
                if is_far(*right) {
                    metres as f32
                } else {
                    *right
                }
            });
            causes.push((Cause::DepthOfBackground(metres), plane));
        }
        if surfaces.is_empty() {
            return causes;
        }
        causes.push((Cause::DepthAlongRay, along_ray.clone()));
        let scale = median(surfaces.iter().map(|[depth, right]| depth / right));
        let scaled = of_surfaces(&|depth| depth * scale);
        causes.push((Cause::DepthScale(scale), scaled));
        if has_planes {
            // A projection with other planes changes 1 / depth by a factor and a constant.
            let points = (surfaces.iter()).map(|[depth, right]| [1.0 / right, 1.0 / depth]);
            let [factor, constant] = fit_line(points);
            let fitted = of_surfaces(&|depth| 1.0 / (factor / depth + constant));
            causes.push((Cause::DepthPlanes(1.0 / factor), fitted));
        }
        causes
    }

    /// Computes the distance along the ray; NaN for the background.
    fn along_ray(&self, scene: &Scene) -> Plane {
        let depth = &self.right.depth;
        let view = tracer::View::new(&scene.camera, 0.0, depth.width, depth.height);
        Raster::from_fn(depth.width, depth.height, |x, y| {
            let ray = view.ray(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let stretch = ray.direction.length() / view.depth(ray.at(1.0));
            match *depth.at(x, y) {
                far if is_far(far) => f32::NAN,
                depth => (f64::from(depth) * stretch) as f32,
            }
        })
    }

    /// Returns whether a plane explains a depth; NaN allows any.
    fn is_explained(&self, depth: f32, expected: f32) -> bool {
        expected.is_nan() || self.is_close(depth, expected)
    }

    fn mark(&self, plane: &Plane) -> Raster<bool> {
        (self.buffer).zip(plane, |depth, expected| {
            self.is_explained(*depth, *expected)
        })
    }

    /// Computes the part of some pixels at which the engine's depth matches a plane.
    fn share(&self, pixels: &[usize], plane: &Plane) -> f64 {
        let is_explained =
            |at: &&usize| self.is_explained(self.buffer.pixels[**at], plane.pixels[**at]);
        let explained = pixels.iter().filter(is_explained);
        explained.count() as f64 / pixels.len().max(1) as f64
    }
}

/// Finds the first cause that explains enough.
fn find_cause(
    causes: Vec<(Cause, Plane)>,
    share: &dyn Fn(&Plane) -> f64,
) -> Option<(Explanation, Plane)> {
    causes.into_iter().find_map(|(cause, plane)| {
        let explained = share(&plane);
        (explained >= LEAST_EXPLAINED).then(|| (Explanation::by(cause, explained), plane))
    })
}

/// Returns whether a depth means that nothing is visible.
fn is_far(depth: f32) -> bool {
    depth >= 0.1 * FAR_DEPTH
}

fn relative_difference(depth: f32, expected: f32) -> f64 {
    match (is_far(depth), is_far(expected)) {
        (true, true) => 0.0,
        (false, false) => f64::from((depth - expected).abs() / expected),
        _ => 1.0,
    }
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
