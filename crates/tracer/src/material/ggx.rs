//! Microfacets: the GGX distribution of normals with height-correlated Smith masking.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

/// A rough surface whose mean normal is +Z; directions point away from it.
///
/// Distribution and masking as in Heitz 2014, "Understanding the Masking-Shadowing Function",
/// sections 5.2 and 6.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ggx {
    /// Width of the distribution of slopes, above 0.
    pub alpha: f64,
}

/// One reflection at the microfacets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reflection {
    /// Radiance sent per radiance arriving per steradian, cosine included, from facets that reflect
    /// everything.
    pub scattered: f64,
    /// Probability per steradian with which [`Ggx::sample`] draws the incoming direction.
    pub density: f64,
    /// Cosine between either direction and the facets that reflect one into the other.
    pub cosine: f64,
}

impl Ggx {
    /// Evaluates a pair of unit directions above the surface.
    pub fn evaluate(&self, outgoing: DVec3, incoming: DVec3) -> Reflection {
        let facet = (outgoing + incoming).normalize();
        let [lambda_out, lambda_in] = [self.lambda(outgoing), self.lambda(incoming)];
        let shared = self.distribution(facet) / (4.0 * outgoing.z);
        Reflection {
            scattered: shared / (1.0 + lambda_out + lambda_in),
            density: shared / (1.0 + lambda_out),
            cosine: outgoing.dot(facet),
        }
    }

    /// Draws the normal of a facet from two numbers in [0, 1), in proportion to how much of it
    /// `outgoing` sees. The incoming direction is `outgoing` reflected at it (Dupuy and Benyoub
    /// 2023, "Sampling Visible GGX Normals with Spherical Caps").
    pub fn sample(&self, outgoing: DVec3, [u, v]: [f64; 2]) -> DVec3 {
        let stretch = DVec3::new(self.alpha, self.alpha, 1.0);
        let straight = (stretch * outgoing).normalize();
        let height = 1.0 - v * (1.0 + straight.z);
        let radius = (1.0 - height * height).max(0.0).sqrt();
        let (sine, cosine) = (TAU * u).sin_cos();
        let cap = DVec3::new(radius * cosine, radius * sine, height) + straight;
        (stretch * cap.with_z(cap.z.max(0.0))).normalize()
    }

    /// The share of light that single reflections return at `cosine`; `fresnel` is the share that a
    /// facet reflects.
    ///
    /// It is integrated by the midpoint rule over [`Ggx::sample`], whose azimuth is symmetric, with
    /// steps that shrink towards the long tail of slopes.
    pub fn albedo(&self, cosine: f64, fresnel: impl Fn(f64) -> f64) -> f64 {
        const STEPS: u32 = 32;
        let outgoing = DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine);
        let lambda_out = self.lambda(outgoing);
        let middle = |step: u32| (f64::from(step) + 0.5) / f64::from(STEPS);
        let [mut sum, mut weights] = [0.0; 2];
        for [row, column] in (0..STEPS * STEPS).map(|step| [step / STEPS, step % STEPS]) {
            let left = 1.0 - middle(column);
            let [place, weight] = [1.0 - left.powi(3), 3.0 * left * left];
            weights += weight;
            let normal = self.sample(outgoing, [0.5 * middle(row), place]);
            let incoming = reflect(outgoing, normal);
            if incoming.z > 0.0 {
                let unmasked = (1.0 + lambda_out) / (1.0 + lambda_out + self.lambda(incoming));
                sum += weight * unmasked * fresnel(outgoing.dot(normal));
            }
        }
        sum / weights
    }

    /// Area of the facets with this normal, per steradian and area of the surface.
    fn distribution(&self, normal: DVec3) -> f64 {
        let slope = DVec2::new(normal.x, normal.y).length_squared() / (self.alpha * self.alpha);
        let spread = slope + normal.z * normal.z;
        1.0 / (PI * self.alpha * self.alpha * spread * spread)
    }

    /// Smith's auxiliary function: area hidden per area seen.
    fn lambda(&self, direction: DVec3) -> f64 {
        let across = DVec2::new(direction.x, direction.y).length_squared();
        let slope = self.alpha * self.alpha * across / (direction.z * direction.z);
        0.5 * ((1.0 + slope).sqrt() - 1.0)
    }
}

/// Reflects a direction, which points away from the surface, at a normal.
pub(crate) fn reflect(direction: DVec3, normal: DVec3) -> DVec3 {
    2.0 * direction.dot(normal) * normal - direction
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_facet_s_density_is_that_of_the_samples() {
        for alpha in [0.2, 0.5, 1.0] {
            for cosine in [0.15, 0.6, 1.0] {
                let ggx = Ggx { alpha };
                let outgoing = DVec3::new((1.0_f64 - cosine * cosine).sqrt(), 0.0, cosine);
                let side = 300;
                let middle = |step: i32| (f64::from(step) + 0.5) / f64::from(side);
                // Both ways count directions above the surface alone: the moments 1, x, z, z^2.
                let moments = |incoming: DVec3| {
                    glam::DVec4::new(1.0, incoming.x, incoming.z, incoming.z * incoming.z)
                };
                let mut sampled = glam::DVec4::ZERO;
                let mut integral = glam::DVec4::ZERO;
                for row in 0..side {
                    for column in 0..side {
                        let normal = ggx.sample(outgoing, [middle(row), middle(column)]);
                        let incoming = reflect(outgoing, normal);
                        if incoming.z > 0.0 {
                            sampled += moments(incoming);
                        }
                        let [height, azimuth] = [middle(row), TAU * middle(column)];
                        let radius = (1.0 - height * height).sqrt();
                        let incoming =
                            DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), height);
                        let density = ggx.evaluate(outgoing, incoming).density;
                        integral += TAU * density * moments(incoming);
                    }
                }
                let difference = (sampled - integral).abs().max_element() / f64::from(side * side);
                // The midpoint rule's error, greatest at grazing angles.
                assert!(difference < 3e-3, "{alpha} {cosine}: {difference}");
            }
        }
    }
}
