//! A last place that no key of an object has, fitted to its velocity.

use frame::Vectors;
use glam::{DMat3, DVec3};

use crate::audit::cause::Cause;
use crate::audit::fitted_motion::{Candidate, TOLERANCE};
use crate::audit::structure::seen_points::{SeenPoint, place_hit};
use crate::audit::structure::wrong_draws::WrongDraws;
use crate::statistics::median;

/// Steps of the search.
const STEPS: usize = 12;
/// Step of a difference quotient, relative to the distance of the object's points.
const SMALL: f64 = 1e-4;
/// Length of the longest step, relative to that distance.
const LONGEST: f64 = 0.5;
/// Error of an outlier, relative to the median.
const OUTLIER: f64 = 4.0;

impl WrongDraws<'_> {
    /// Fits a way in the world from an object's last place to the one that its velocity comes from,
    /// by Gauss and Newton's method; none for the background.
    pub fn find_teleport(
        &self,
        buffer: &Vectors,
        object: usize,
        pixels: &[usize],
    ) -> Option<Candidate> {
        let draw = self.draw_rightly(Some(object));
        let samples: Vec<Sample> = (pixels.iter())
            .filter_map(|at| {
                let point = self.points[*at].as_ref()?;
                let SeenPoint::Surface(hit) = point else {
                    return None;
                };
                let this = point.place(self.scene, &draw.this);
                let vector = buffer.pixels[*at];
                Some(Sample {
                    last: place_hit(hit, self.scene, &draw.last),
                    from: [0, 1].map(|axis| this[axis] - f64::from(vector[axis])),
                })
            })
            .collect();
        let first = samples.first()?;
        let scale = (first.last).distance(self.scene.camera.motion.at(-1.0).translation);
        let project = |point: DVec3| draw.last.camera.project_point(point);
        let mut way = DVec3::ZERO;
        for _ in 0..STEPS {
            let near = select_near(&samples, way, &project);
            let step = find_step(&near, way, SMALL * scale, &project)?;
            way += step.clamp_length_max(LONGEST * scale);
        }
        let velocity = self.velocity(pixels, &|_| {
            let mut moved = draw;
            moved.last.to_world.translation += way;
            moved
        });
        Some((Cause::Teleport(way.to_array()), velocity))
    }
}

/// A point in the world one frame ago, and the pixel that an engine has it come from.
struct Sample {
    last: DVec3,
    from: [f64; 2],
}

/// Selects the points that a way brings as near to their pixels as most, within a few times.
fn select_near<'a>(
    samples: &'a [Sample],
    way: DVec3,
    project: &dyn Fn(DVec3) -> [f64; 2],
) -> Vec<&'a Sample> {
    let error = |sample: &Sample| {
        let place = project(sample.last + way);
        (place[0] - sample.from[0]).hypot(place[1] - sample.from[1])
    };
    let usual = median(samples.iter().map(error));
    let is_near = |sample: &&Sample| error(sample) <= OUTLIER * usual + TOLERANCE;
    samples.iter().filter(is_near).collect()
}

/// Finds the change of the way that brings points to their pixels, to first order.
fn find_step(
    samples: &[&Sample],
    way: DVec3,
    small: f64,
    project: &dyn Fn(DVec3) -> [f64; 2],
) -> Option<DVec3> {
    let mut square = DMat3::ZERO;
    let mut product = DVec3::ZERO;
    for sample in samples {
        let point = sample.last + way;
        let place = project(point);
        let [x, y, z] = DVec3::AXES.map(|axis| project(point + small * axis));
        for axis in [0, 1] {
            let slope = DVec3::new(x[axis], y[axis], z[axis]) - DVec3::splat(place[axis]);
            let slope = slope / small;
            square += DMat3::from_cols(slope * slope.x, slope * slope.y, slope * slope.z);
            product += slope * (sample.from[axis] - place[axis]);
        }
    }
    let step = square.inverse() * product;
    step.is_finite().then_some(step)
}
