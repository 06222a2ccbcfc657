//! Directions sampled to the background.

use std::f64::consts::TAU;

use glam::DVec3;
use scene::Background;

use crate::light::environment::EnvironmentSampler;
use crate::light::lights::LightSample;

/// Ratio of the brightest to the darkest level above which a sky is sampled as a light. A more even
/// sky is left to the BRDFs, which sample it nearly in proportion to its radiance: another shadow
/// ray per bounce would lower the noise by less than as many more samples.
const UNEVEN: f64 = 8.0;

/// A background, prepared to be sampled as a light.
pub(crate) struct Sky<'a> {
    background: &'a Background,
    profile: Profile,
}

/// The method of drawing directions.
enum Profile {
    /// No directions, because the sky is even.
    Even,
    /// Heights, in proportion to the strongest component at -1, 0 and 1, linear between them.
    Heights([f64; 3]),
    /// Texels of the map.
    Map(EnvironmentSampler),
}

impl<'a> Sky<'a> {
    pub fn new(background: &'a Background) -> Self {
        let profile = match background {
            Background::Constant(_) => Profile::Even,
            Background::Gradient {
                ground,
                horizon,
                zenith,
            } => {
                let strengths =
                    [ground, horizon, zenith].map(|level| f64::from(level.max_element()));
                let brightest = strengths.into_iter().fold(0.0, f64::max);
                let darkest = strengths.into_iter().fold(f64::INFINITY, f64::min);
                if is_uneven([brightest, darkest]) {
                    Profile::Heights(strengths)
                } else {
                    Profile::Even
                }
            }
            Background::Map(map) => match EnvironmentSampler::new(map) {
                Some(sampler) if is_uneven(sampler.extremes()) => Profile::Map(sampler),
                _ => Profile::Even,
            },
        };
        Self {
            background,
            profile,
        }
    }

    /// Returns true if [`Sky::sample`] draws directions.
    pub fn is_sampled(&self) -> bool {
        !matches!(self.profile, Profile::Even)
    }

    /// Draws a direction from two numbers in [0, 1); none from an even sky.
    pub fn sample(&self, [u, v]: [f64; 2]) -> Option<LightSample> {
        match (&self.profile, self.background) {
            (Profile::Map(sampler), Background::Map(map)) => Some(sampler.sample(map, [u, v])),
            (Profile::Heights(strengths), _) => {
                Some(self.sample_at_height(sample_height(*strengths, u), v))
            }
            _ => None,
        }
    }

    /// The probability per steradian with which [`Sky::sample`] draws a unit direction.
    pub fn density(&self, direction: DVec3) -> f64 {
        match (&self.profile, self.background) {
            (Profile::Map(sampler), Background::Map(map)) => sampler.density(map, direction),
            (Profile::Heights([ground, horizon, zenith]), _) => {
                let height = direction.y.clamp(-1.0, 1.0);
                let end = if height < 0.0 { ground } else { zenith };
                let total = 0.5 * (ground + horizon) + 0.5 * (horizon + zenith);
                (horizon + (end - horizon) * height.abs()) / (total * TAU)
            }
            _ => 0.0,
        }
    }

    fn sample_at_height(&self, height: f64, v: f64) -> LightSample {
        let (sine, cosine) = (TAU * v).sin_cos();
        let level = (1.0 - height * height).max(0.0).sqrt();
        let direction = DVec3::new(level * cosine, height, level * sine);
        LightSample {
            direction,
            distance: f64::INFINITY,
            radiance: self.background.radiance(direction),
            density: self.density(direction),
        }
    }
}

fn is_uneven([brightest, darkest]: [f64; 2]) -> bool {
    brightest > UNEVEN * darkest
}

/// Draws a height. Its density is linear on either side of the horizon; equal ranges of height have
/// equal solid angles.
fn sample_height([ground, horizon, zenith]: [f64; 3], u: f64) -> f64 {
    let [below, above] = [ground + horizon, horizon + zenith];
    let split = below / (below + above);
    if u < split {
        -sample_linear(horizon, ground, 1.0 - u / split)
    } else {
        sample_linear(horizon, zenith, (u - split) / (1.0 - split))
    }
}

/// Draws a place in [0, 1] from a number in [0, 1], with a density that is linear from `from` to
/// `to` (Pharr, Jakob and Humphreys 2023, A.4.1).
fn sample_linear(from: f64, to: f64, u: f64) -> f64 {
    let slope = from + ((1.0 - u) * from * from + u * to * to).sqrt();
    if slope > 0.0 {
        (u * (from + to) / slope).min(1.0)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn an_even_sky_is_left_to_the_lobe() {
        let even = Background::Gradient {
            ground: Vec3::splat(0.2),
            horizon: Vec3::splat(1.0),
            zenith: Vec3::splat(0.9),
        };
        let constant = [Vec3::ZERO, Vec3::new(0.5, 0.25, 1.0)].map(Background::Constant);
        for background in constant.into_iter().chain([even]) {
            let sky = Sky::new(&background);
            assert!(sky.sample([0.5, 0.5]).is_none());
            assert_eq!(sky.density(DVec3::Y), 0.0);
        }
    }
}
