//! The path integrator: radiance along one path.

use bvh::Ray;
use glam::{DVec3, Vec3};

use crate::hit::{Hit, LIFT};
use crate::light::lights::{
    Emitters, LightSample, density_per_steradian, power_heuristic, sample_sun, sun_density,
};
use crate::material::brdf::Brdf;
use crate::material::brdf_sample::{BrdfSample, BrdfValue};
use crate::material::passage::Passage;
use crate::material::surface::Surface;
use crate::motion::poses::Poses;
use crate::path::stops::{Stop, find_stop};
use crate::sampler::Sampler;
use crate::stage::Stage;

/// Bounce at which roulette begins; before it every path goes on.
const ROULETTE_FROM: u32 = 4;
/// Most bounces of a path. Roulette ends nearly all paths long before: at albedo 0.8 one in a
/// million gets here.
const MAX_BOUNCES: u32 = 64;

/// Traces paths through a stage.
pub(crate) struct Integrator<'a> {
    pub stage: &'a Stage<'a>,
    pub emitters: Emitters,
    /// True if light comes from points on the sun's disc or on emitters.
    draws_points: bool,
}

/// Density with which a ray's direction was sampled; none for rays of the camera and of mirrors,
/// which no light could have sampled.
type RayDensity = Option<f64>;

impl<'a> Integrator<'a> {
    /// Prepares the emitters with their weights at `time` (frames).
    pub fn new(stage: &'a Stage<'a>, time: f64) -> Self {
        let emitters = Emitters::new(stage.scene, stage.poses().at(time));
        let mut suns = stage.scene.sun.iter();
        Self {
            stage,
            draws_points: !emitters.triangles.is_empty()
                || suns.any(|sun| sun.angular_radius > 0.0),
            emitters,
        }
    }

    /// Follows a path from where its camera ray stops, or from the background if it does not;
    /// returns its radiance and the number of bounces.
    pub fn follow_path(
        &self,
        poses: &mut Poses,
        camera_ray: Ray,
        first_stop: Option<Stop>,
        sampler: &Sampler,
    ) -> (Vec3, u32) {
        let scene = self.stage.scene;
        let mut radiance = Vec3::ZERO;
        let mut ray = camera_ray;
        let mut next_stop = first_stop;
        let mut density: RayDensity = None;
        let mut throughput = Vec3::ONE;
        for depth in 0..MAX_BOUNCES {
            let Some(Stop { hit, mirrors }) = next_stop else {
                radiance += throughput * self.background_radiance(&ray, density);
                return (radiance, depth);
            };
            let surface = Surface::at(scene, poses.pose(hit.object), &ray, &hit);
            // The greatest length that the position was computed from.
            let magnitude = surface.position.abs().max_element().max(hit.t);
            let start = surface.position + LIFT * magnitude * surface.facet;
            let sampled = if mirrors {
                let passage = Passage::at(scene, poses, &ray, &hit);
                let weight = passage.map_or(Vec3::ZERO, |passage| passage.reflected);
                let direction = ray.direction.reflect(surface.facet);
                BrdfSample {
                    direction,
                    weight,
                    density: None,
                }
            } else {
                radiance += throughput * self.emission(&surface, &ray, &hit, density);
                let glossy = self.stage.glossy_materials[surface.material].as_ref();
                let Some(brdf) = surface.brdf(glossy, &ray) else {
                    return (radiance, depth);
                };
                let ([lights, sky], sampled) = self.scatter(poses, start, &brdf, depth, sampler);
                radiance += throughput * lights;
                radiance += throughput * sky;
                let Some(sampled) = sampled else {
                    return (radiance, depth + 1);
                };
                sampled
            };
            throughput *= sampled.weight;
            if depth >= ROULETTE_FROM {
                let [_, _, roulette, _] = sampler.bounce(depth);
                // Paths that survive by the throughput itself are too few and too bright: their
                // noise would cost more than the rays that end.
                let survival = f64::from(throughput.max_element()).min(1.0).sqrt();
                if roulette >= survival {
                    return (radiance, depth + 1);
                }
                throughput /= survival as f32;
            }
            density = sampled.density;
            ray = Ray {
                origin: start,
                direction: sampled.direction,
            };
            let passed;
            (next_stop, passed) = find_stop(self.stage, poses, &ray, || sampler.passage(depth));
            throughput *= passed;
        }
        (radiance, MAX_BOUNCES)
    }

    /// Gathers the light of lights and the sky that a surface scatters, and draws the path's next
    /// direction.
    fn scatter(
        &self,
        poses: &mut Poses,
        start: DVec3,
        brdf: &Brdf,
        depth: u32,
        sampler: &Sampler,
    ) -> ([Vec3; 2], Option<BrdfSample>) {
        let [u, v, _, choice] = sampler.bounce(depth);
        let sky_numbers = match (brdf, self.stage.sky.is_sampled()) {
            // Nothing uses them.
            (Brdf::Diffuse { .. }, false) => [0.0; 4],
            _ => sampler.sky(depth),
        };
        let [sky_u, sky_v, lobe_choice, _] = sky_numbers;
        let mut light = [Vec3::ZERO; 2];
        if self.stage.scene.sun.is_some() || !self.emitters.triangles.is_empty() {
            let points = if self.draws_points {
                sampler.lights(depth)
            } else {
                [0.0; 4]
            };
            light[0] = self.direct_light(poses, start, brdf, choice, points);
        }
        if let Some(sky) = self.stage.sky.sample([sky_u, sky_v]) {
            light[1] = self.light_from(poses, start, brdf, &sky, true);
        }
        (light, brdf.sample(lobe_choice, [u, v]))
    }

    /// Radiance of the background and the sun's disc, weighted against the chance that light
    /// sampling drew the ray.
    fn background_radiance(&self, ray: &Ray, density: RayDensity) -> Vec3 {
        let scene = self.stage.scene;
        let weight = density.map_or(1.0, |density| {
            power_heuristic(density, self.stage.sky.density(ray.direction))
        });
        let background = scene.background.radiance(ray.direction) * weight as f32;
        match &scene.sun {
            Some(sun) if sun.covers(ray.direction) => {
                let weight =
                    density.map_or(1.0, |density| power_heuristic(density, sun_density(sun)));
                background + sun.radiance() * weight as f32
            }
            _ => background,
        }
    }

    /// Radiance that a surface emits, weighted against the chance that light sampling drew the ray.
    fn emission(&self, surface: &Surface, ray: &Ray, hit: &Hit, density: RayDensity) -> Vec3 {
        if surface.emission == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let weight = density.map_or(1.0, |density| {
            let cosine = surface.facet.dot(ray.direction);
            let by_light = self.emitters.chance(hit.object, hit.triangle)
                * density_per_steradian(surface.area, hit.t, cosine);
            power_heuristic(density, by_light)
        });
        surface.emission * weight as f32
    }

    /// Light from the sun and from one emitter, scattered by a surface. The random numbers choose
    /// the emitter, the point on it and the point on the sun.
    fn direct_light(
        &self,
        poses: &mut Poses,
        start: DVec3,
        brdf: &Brdf,
        choice: f64,
        [u, v, sun_u, sun_v]: [f64; 4],
    ) -> Vec3 {
        let scene = self.stage.scene;
        let mut light = Vec3::ZERO;
        if let Some(sun) = &scene.sun {
            let by_surface = sun.angular_radius > 0.0;
            light += self.light_from(
                poses,
                start,
                brdf,
                &sample_sun(sun, [sun_u, sun_v]),
                by_surface,
            );
        }
        if let Some(sampled) = self.emitters.sample(scene, poses, start, choice, [u, v]) {
            light += self.light_from(poses, start, brdf, &sampled, true);
        }
        light
    }

    /// Light from one light sample, scattered by a surface. `by_surface` says that the BRDF might
    /// have sampled the direction too.
    fn light_from(
        &self,
        poses: &mut Poses,
        start: DVec3,
        brdf: &Brdf,
        light: &LightSample,
        by_surface: bool,
    ) -> Vec3 {
        let BrdfValue { scattered, density } = brdf.evaluate(light.direction);
        if scattered == Vec3::ZERO || light.radiance == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let ray = Ray {
            origin: start,
            direction: light.direction,
        };
        // The light's own triangle is at the end of the ray.
        let limit = light.distance * (1.0 - LIFT);
        let passed = self.stage.transmittance(poses, &ray, limit);
        if passed == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let weight = if by_surface {
            power_heuristic(light.density, density)
        } else {
            1.0
        };
        passed * (light.radiance * scattered * (weight / light.density) as f32)
    }
}
