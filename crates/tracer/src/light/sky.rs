//! Directions sampled to the background.

use glam::DVec3;
use scene::Background;

use crate::light::environment::EnvironmentSampler;
use crate::light::lights::LightSample;

/// Ratio of the brightest to the darkest texel above which a map is sampled as a light. A more even
/// one is left to the BRDFs, which sample it nearly in proportion to its radiance, and so is a
/// gradient, which has no small bright part: another shadow ray per bounce would lower the noise
/// by less than as many more samples.
const UNEVEN: f64 = 8.0;

/// A background, prepared to be sampled as a light.
pub(crate) struct Sky<'a> {
    background: &'a Background,
    /// Draws directions of an uneven map; none for other backgrounds.
    sampler: Option<EnvironmentSampler>,
}

impl<'a> Sky<'a> {
    pub fn new(background: &'a Background) -> Self {
        let sampler = match background {
            Background::Map(map) => EnvironmentSampler::new(map),
            Background::Constant(_) | Background::Gradient { .. } => None,
        };
        Self {
            background,
            sampler: sampler.filter(|sampler| {
                let [brightest, darkest] = sampler.extremes();
                brightest > UNEVEN * darkest
            }),
        }
    }

    /// Returns true if [`Sky::sample`] draws directions.
    pub fn is_sampled(&self) -> bool {
        self.sampler.is_some()
    }

    /// Draws a direction from two numbers in [0, 1); none if the sky is left to the BRDFs.
    pub fn sample(&self, numbers: [f64; 2]) -> Option<LightSample> {
        match (&self.sampler, self.background) {
            (Some(sampler), Background::Map(map)) => Some(sampler.sample(map, numbers)),
            _ => None,
        }
    }

    /// The probability per steradian with which [`Sky::sample`] draws a unit direction.
    pub fn density(&self, direction: DVec3) -> f64 {
        match (&self.sampler, self.background) {
            (Some(sampler), Background::Map(map)) => sampler.density(map, direction),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use scene::EnvironmentMap;

    use super::*;

    fn gradient(horizon: f32, zenith: f32) -> Background {
        Background::Gradient {
            ground: Vec3::splat(0.2),
            horizon: Vec3::splat(horizon),
            zenith: Vec3::splat(zenith),
        }
    }

    /// A map of grey texels, the first of which is brighter.
    fn map(bright: f32) -> Background {
        let mut texels = vec![[1.0; 3]; 128];
        texels[0] = [bright; 3];
        Background::Map(EnvironmentMap {
            path: "made by a test".into(),
            width: 16,
            height: 8,
            texels,
            strength: 2.0,
            rotation: 0.0,
        })
    }

    #[test]
    fn all_but_an_uneven_map_is_left_to_the_lobe() {
        let constant = [Vec3::ZERO, Vec3::new(0.5, 0.25, 1.0)].map(Background::Constant);
        let gradients = [gradient(1.0, 0.9), gradient(0.01, 50.0)];
        for background in constant.into_iter().chain(gradients).chain([map(5.0)]) {
            let sky = Sky::new(&background);
            assert!(!sky.is_sampled());
            assert!(sky.sample([0.5, 0.5]).is_none());
            assert_eq!(sky.density(DVec3::Y), 0.0);
        }
        let uneven = map(500.0);
        let sky = Sky::new(&uneven);
        assert!(sky.is_sampled());
        let sample = sky.sample([0.5, 0.5]).expect("it is sampled");
        assert_eq!(sky.density(sample.direction), sample.density);
    }
}
