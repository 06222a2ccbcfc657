//! The light that a translucent surface stops, reflects and lets pass.

use bvh::Ray;
use glam::Vec3;
use scene::Scene;

use crate::hit::Hit;
use crate::material::fresnel;
use crate::material::surface::{find_material, incidence, opacity};
use crate::motion::poses::Poses;

/// Shares of the light along a ray through one point of a translucent surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Passage {
    /// Share that ends at the surface itself, from 0 to 1.
    pub opacity: f64,
    /// Share of the rest that a pane of glass reflects.
    pub reflected: Vec3,
    /// Share of the rest that passes straight through.
    pub passed: Vec3,
}

impl Passage {
    /// The passage at a hit of a ray; none if the surface is not translucent.
    pub fn at(scene: &Scene, poses: &mut Poses, ray: &Ray, hit: &Hit) -> Option<Self> {
        let translucency = find_material(scene, hit.object, hit.triangle).translucency?;
        let [reflected, passed] = match translucency.glass {
            None => [Vec3::ZERO, translucency.filter],
            Some(index) => {
                let cosine = incidence(scene, poses.pose(hit.object), ray, hit);
                split_by_pane(f64::from(index), cosine, translucency.filter)
            }
        };
        Some(Self {
            opacity: f64::from(opacity(scene, hit.object, hit.triangle, hit.weights)),
            reflected,
            passed,
        })
    }

    /// The share of the light that passes the surface.
    pub fn transmittance(&self) -> Vec3 {
        (1.0 - self.opacity) as f32 * self.passed
    }

    /// The chance that light that is not stopped is reflected: its share, by the mean of the
    /// components.
    pub fn chance_of_reflection(&self) -> f64 {
        let [reflected, passed] =
            [self.reflected, self.passed].map(|share| f64::from(share.element_sum()));
        if reflected > 0.0 {
            reflected / (reflected + passed)
        } else {
            0.0
        }
    }
}

/// The shares that a flat pane reflects and lets pass, with all reflections between its two sides.
/// Between them, light keeps the share `filter` of each component.
///
/// The sides reflect `r` each, by Fresnel's equations, and the series of all ways through sums to
/// `T = (1 - r)^2 a / (1 - r^2 a^2)` and `R = r + r a T` (Born and Wolf, "Principles of Optics",
/// 7.6, without interference).
fn split_by_pane(index: f64, cosine: f64, filter: Vec3) -> [Vec3; 2] {
    let r = fresnel::dielectric(index, cosine).min(1.0);
    let split = |a: f32| {
        let a = f64::from(a);
        let round_trip = r * r * a * a;
        let passed = if round_trip < 1.0 {
            (1.0 - r).powi(2) * a / (1.0 - round_trip)
        } else {
            0.0
        };
        [r + r * a * passed, passed].map(|share| share as f32)
    };
    let parts = filter.to_array().map(split);
    [0, 1].map(|side| Vec3::from(parts.map(|part| part[side])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_of_a_tinted_pane_is_the_sum_of_its_ways() {
        let filter = Vec3::new(0.9, 0.5, 0.0);
        let [reflected, passed] = split_by_pane(1.7, 0.3, filter);
        let r = fresnel::dielectric(1.7, 0.3);
        for (component, a) in filter.to_array().map(f64::from).into_iter().enumerate() {
            // Light inside the pane after each passage from side to side.
            let (mut out, mut back, mut inside) = (0.0, r, (1.0 - r) * a);
            for _ in 0..100 {
                out += (1.0 - r) * inside;
                back += (1.0 - r) * r * a * inside;
                inside *= r * r * a * a;
            }
            assert!((f64::from(passed[component]) - out).abs() < 1e-6);
            assert!((f64::from(reflected[component]) - back).abs() < 1e-6);
        }
    }
}
