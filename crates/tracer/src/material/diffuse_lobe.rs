//! The cosine lobe of a diffuse surface.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

/// A cosine lobe about the shading normal, with its part below the facet mirrored up.
///
/// Interpolated normals turn part of the lobe into the body. Without that part every smooth mesh
/// would be too dark. Mirrored at the facet it keeps the albedo exact, and sampling still agrees
/// with evaluation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DiffuseLobe {
    facet: DVec3,
    normal: DVec3,
}

impl DiffuseLobe {
    /// The lobe of unit vectors that are within 90 degrees of one another.
    pub fn new(facet: DVec3, normal: DVec3) -> Self {
        Self { facet, normal }
    }

    /// Probability per steradian of a unit direction. The scattered share of light is the albedo
    /// times this.
    pub fn density(&self, direction: DVec3) -> f64 {
        let above = direction.dot(self.facet);
        if above <= 0.0 {
            return 0.0;
        }
        let mirrored = direction - 2.0 * above * self.facet;
        (self.normal.dot(direction).max(0.0) + self.normal.dot(mirrored).max(0.0)) / PI
    }

    /// Draws a direction of that density from two numbers in [0, 1).
    pub fn sample(&self, u: f64, v: f64) -> DVec3 {
        let radius = u.sqrt();
        let (sine, cosine) = (TAU * v).sin_cos();
        let (tangent, bitangent) = self.normal.any_orthonormal_pair();
        let direction =
            radius * cosine * tangent + radius * sine * bitangent + (1.0 - u).sqrt() * self.normal;
        let above = direction.dot(self.facet);
        direction + 2.0 * (-above).max(0.0) * self.facet
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Normals that deviate from the facet's by nothing, by half a right angle and by nearly a
    /// right angle.
    fn lobes() -> Vec<DiffuseLobe> {
        let facet = DVec3::new(0.6, 0.0, 0.8);
        [0.0, 0.8, 1.5]
            .map(|tilt: f64| {
                let aside = DVec3::new(0.8, 0.0, -0.6);
                DiffuseLobe::new(facet, tilt.cos() * facet + tilt.sin() * aside)
            })
            .to_vec()
    }

    /// The integral of `value` times density over the sphere, by the midpoint rule in height and
    /// azimuth.
    fn integral(lobe: &DiffuseLobe, value: impl Fn(DVec3) -> DVec3) -> DVec3 {
        let steps = 400;
        let mut sum = DVec3::ZERO;
        for row in 0..steps {
            let z = 2.0 * (f64::from(row) + 0.5) / f64::from(steps) - 1.0;
            for column in 0..steps {
                let azimuth = TAU * (f64::from(column) + 0.5) / f64::from(steps);
                let radius = (1.0 - z * z).sqrt();
                let direction = DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), z);
                sum += lobe.density(direction) * value(direction);
            }
        }
        sum * 2.0 * TAU / f64::from(steps * steps)
    }

    #[test]
    fn the_density_is_that_of_the_samples_and_adds_up_to_one() {
        for lobe in lobes() {
            // The midpoint rule errs by 1e-3 where the density jumps at the facet.
            assert!((integral(&lobe, |_| DVec3::ONE).x - 1.0).abs() < 2e-3);
            let side = 200;
            let mut mean = DVec3::ZERO;
            for index in 0..side * side {
                let at = |index: u32| (f64::from(index) + 0.5) / f64::from(side);
                let direction = lobe.sample(at(index % side), at(index / side));
                assert!((direction.length() - 1.0).abs() < 1e-12);
                assert!(direction.dot(lobe.facet) >= 0.0 && lobe.density(direction) > 0.0);
                mean += direction / f64::from(side * side);
            }
            assert!(mean.distance(integral(&lobe, |direction| direction)) < 2e-3);
        }
    }
}
