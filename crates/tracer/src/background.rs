//! What rays see that leave the scene.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};

use crate::lights::LightSample;
use crate::scene::Background;

/// A sky whose brightest level is more than this many times its darkest is drawn as a light. A more even one is left to
/// the surfaces' own lobes, which draw nearly in proportion to what it sends: there another shadow ray a bounce lowers
/// the noise by less than as many more samples would.
const UNEVEN: f64 = 8.0;

impl Background {
    /// Radiance from a unit direction.
    pub fn radiance(&self, direction: DVec3) -> Vec3 {
        let [ground, horizon, zenith] = self.levels();
        let height = direction.y as f32;
        if height < 0.0 {
            horizon.lerp(ground, -height)
        } else {
            horizon.lerp(zenith, height)
        }
    }

    /// A direction drawn in proportion to the strongest component's profile over the height, from two numbers in
    /// [0, 1); none from an even sky.
    pub(crate) fn sample(&self, [u, v]: [f64; 2]) -> Option<LightSample> {
        if !self.is_drawn() {
            return None;
        }
        let [ground, horizon, zenith] = self.strengths();
        let [below, above] = [ground + horizon, horizon + zenith];
        // The height's density is linear on either side of the horizon; equal heights have equal solid angles.
        let split = below / (below + above);
        let height = if u < split {
            -linear(horizon, ground, 1.0 - u / split)
        } else {
            linear(horizon, zenith, (u - split) / (1.0 - split))
        };
        let (sine, cosine) = (TAU * v).sin_cos();
        let level = (1.0 - height * height).max(0.0).sqrt();
        let direction = DVec3::new(level * cosine, height, level * sine);
        Some(LightSample {
            direction,
            distance: f64::INFINITY,
            radiance: self.radiance(direction),
            density: self.density(direction),
        })
    }

    /// Probability per steradian with which [`Background::sample`] draws a unit direction.
    pub(crate) fn density(&self, direction: DVec3) -> f64 {
        if !self.is_drawn() {
            return 0.0;
        }
        let [ground, horizon, zenith] = self.strengths();
        let height = direction.y.clamp(-1.0, 1.0);
        let end = if height < 0.0 { ground } else { zenith };
        let total = 0.5 * (ground + horizon) + 0.5 * (horizon + zenith);
        (horizon + (end - horizon) * height.abs()) / (total * TAU)
    }

    /// Radiance at heights -1, 0 and 1.
    fn levels(&self) -> [Vec3; 3] {
        match *self {
            Background::Constant(radiance) => [radiance; 3],
            Background::Gradient {
                ground,
                horizon,
                zenith,
            } => [ground, horizon, zenith],
        }
    }

    fn is_drawn(&self) -> bool {
        let strengths = self.strengths();
        let brightest = strengths.into_iter().fold(0.0, f64::max);
        let darkest = strengths.into_iter().fold(f64::INFINITY, f64::min);
        brightest > UNEVEN * darkest
    }

    fn strengths(&self) -> [f64; 3] {
        self.levels().map(|level| f64::from(level.max_element()))
    }
}

/// Where in [0, 1] a number in [0, 1] falls under a density that goes linearly from `from` to `to` (Pharr, Jakob and
/// Humphreys 2023, A.4.1).
fn linear(from: f64, to: f64, u: f64) -> f64 {
    let slope = from + ((1.0 - u) * from * from + u * to * to).sqrt();
    if slope > 0.0 {
        (u * (from + to) / slope).min(1.0)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SKIES: [Background; 3] = [
        Background::Gradient {
            ground: Vec3::new(0.2, 0.1, 0.0),
            horizon: Vec3::new(0.75, 0.85, 1.0),
            zenith: Vec3::new(0.25, 0.45, 3.0),
        },
        Background::Gradient {
            ground: Vec3::ZERO,
            horizon: Vec3::ZERO,
            zenith: Vec3::new(1.0, 2.0, 0.5),
        },
        Background::Gradient {
            ground: Vec3::ONE,
            horizon: Vec3::ZERO,
            zenith: Vec3::ZERO,
        },
    ];

    #[test]
    fn drawn_directions_estimate_the_whole_sky() {
        const SIDE: usize = 256;
        for sky in SKIES {
            let mut estimate = DVec3::ZERO;
            let mut moment = 0.0;
            for at in 0..SIDE * SIDE {
                let middle = |cell: usize| (cell as f64 + 0.5) / SIDE as f64;
                let drawn = sky.sample([middle(at % SIDE), middle(at / SIDE)]).unwrap();
                assert_eq!(drawn.density, sky.density(drawn.direction));
                assert_eq!(drawn.radiance, sky.radiance(drawn.direction));
                assert!((drawn.direction.length() - 1.0).abs() < 1e-12);
                let weighted = drawn.radiance.as_dvec3() / drawn.density;
                estimate += weighted / (SIDE * SIDE) as f64;
                moment += weighted.y * drawn.direction.y / (SIDE * SIDE) as f64;
            }
            // A linear profile's mean is that of its ends; both halves have a solid angle of 2 pi.
            let [ground, horizon, zenith] = sky.levels().map(|level| level.as_dvec3());
            let whole = TAU * 0.5 * (ground + 2.0 * horizon + zenith);
            // Midpoints of 256 x 256 cells; the integrand is smooth but for the horizon's kink.
            assert!((estimate - whole).abs().max_element() < 1e-3 * whole.max_element());
            // First moment over the height: -1/6, 1/6 of the horizon cancel, ends weigh 1/3.
            let leaning = TAU * (zenith.y - ground.y) / 3.0;
            assert!(
                (moment - leaning).abs() < 1e-3 * whole.y,
                "{moment} {leaning}"
            );
        }
    }

    #[test]
    fn the_density_is_one_over_the_sphere() {
        const STEPS: usize = 10_000;
        for sky in SKIES {
            let sum: f64 = (0..STEPS)
                .map(|step| -1.0 + 2.0 * (step as f64 + 0.5) / STEPS as f64)
                .map(|height| sky.density(DVec3::new((1.0 - height * height).sqrt(), height, 0.0)))
                .sum();
            // Equal steps of height are equal solid angles.
            let total = sum / STEPS as f64 * 2.0 * TAU;
            assert!((total - 1.0).abs() < 1e-6, "{total}");
        }
    }

    #[test]
    fn an_even_sky_is_left_to_the_lobe() {
        let even = Background::Gradient {
            ground: Vec3::splat(0.2),
            horizon: Vec3::splat(1.0),
            zenith: Vec3::splat(0.9),
        };
        let constant = [Vec3::ZERO, Vec3::new(0.5, 0.25, 1.0)].map(Background::Constant);
        for sky in constant.into_iter().chain([even]) {
            assert!(sky.sample([0.5, 0.5]).is_none());
            assert_eq!(sky.density(DVec3::Y), 0.0);
        }
    }
}
