//! Light along one path: the integrand.

use glam::{DVec3, Vec3};

use crate::film::sampler::Sampler;
use crate::geometry::ray::Ray;
use crate::light::lights::{Emitters, LightSample, density_per_steradian, power_heuristic};
use crate::material::brdf::{Brdf, Scattered};
use crate::material::surface::Surface;
use crate::motion::poses::Poses;
use crate::stage::{Hit, Stage};

/// Roulette begins at this bounce: before, every path goes on.
const ROULETTE_FROM: u32 = 3;
/// No path is longer. Roulette ends nearly all long before: at albedo 0.8 one in a million gets so far.
const MOST_BOUNCES: u32 = 64;
/// Secondary rays start this far off their surface, as a part of the greatest coordinate: positions are exact to
/// about 1e-14 of it.
pub(crate) const LIFT: f64 = 1e-9;

/// Traces paths through a stage.
pub(crate) struct Integrator<'a> {
    pub stage: &'a Stage<'a>,
    pub emitters: Emitters,
}

/// What one path brings home.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PathSample {
    pub radiance: Vec3,
    /// The surface seen first; none for the background.
    pub hit: Option<Hit>,
    /// Whether that surface scattered any light, or sent only its own.
    pub scattered: bool,
}

impl PathSample {
    /// The object seen first, by id: 0 is the background.
    pub fn object_id(&self) -> usize {
        self.hit.map_or(0, |hit| hit.object + 1)
    }
}

/// The density of the direction that a ray was drawn with; none for rays that lights cannot draw: the camera's and those in
/// a mirror.
type Drawn = Option<f64>;

impl<'a> Integrator<'a> {
    /// Emitters are weighted as they are at `time` (frames).
    pub fn new(stage: &'a Stage<'a>, time: f64) -> Self {
        Self {
            stage,
            emitters: Emitters::of(stage.scene, stage.poses().at(time)),
        }
    }

    /// Radiance that arrives along a camera ray, at the time of `poses`.
    pub fn trace(&self, poses: &mut Poses, camera_ray: Ray, sampler: &Sampler) -> PathSample {
        let hit = self.stage.closest(poses, &camera_ray);
        let (radiance, bounces) = self.follow(poses, camera_ray, hit, sampler);
        PathSample {
            radiance,
            hit,
            scattered: bounces > 0,
        }
    }

    /// Radiance that arrives along a camera ray which meets a known surface first.
    pub fn radiance_along(
        &self,
        poses: &mut Poses,
        camera_ray: Ray,
        first_hit: Option<Hit>,
        sampler: &Sampler,
    ) -> Vec3 {
        self.follow(poses, camera_ray, first_hit, sampler).0
    }

    /// The path from its first hit on: its radiance, and how often it was scattered.
    fn follow(
        &self,
        poses: &mut Poses,
        camera_ray: Ray,
        first_hit: Option<Hit>,
        sampler: &Sampler,
    ) -> (Vec3, u32) {
        let scene = self.stage.scene;
        let mut radiance = Vec3::ZERO;
        let mut ray = camera_ray;
        let mut met = first_hit;
        let mut drawn: Drawn = None;
        let mut throughput = Vec3::ONE;
        for depth in 0..MOST_BOUNCES {
            let Some(hit) = met else {
                radiance += throughput * self.beyond(&ray, drawn);
                return (radiance, depth);
            };
            let surface = Surface::at(scene, poses.pose(hit.object), &ray, &hit);
            radiance += throughput * self.emitted(&surface, &ray, &hit, drawn);
            let gloss = self.stage.gloss(surface.material);
            let Some(brdf) = surface.brdf(gloss, &ray) else {
                return (radiance, depth);
            };
            let [u, v, roulette, choice] = sampler.bounce(depth);
            let [sky_u, sky_v, by_facets, _] = sampler.sky(depth);
            let start = surface.position + LIFT * magnitude(&surface, &hit) * surface.facet;
            if self.has_lights() {
                let points = sampler.lights(depth);
                radiance += throughput * self.direct(poses, start, &brdf, choice, points);
            }
            if let Some(sky) = self.stage.sky().sample([sky_u, sky_v]) {
                radiance += throughput * self.arriving(poses, start, &brdf, &sky, true);
            }
            let Some(draw) = brdf.sample(by_facets, [u, v]) else {
                return (radiance, depth + 1);
            };
            throughput *= draw.weight;
            if depth >= ROULETTE_FROM {
                let survival = f64::from(throughput.max_element()).min(1.0);
                if roulette >= survival {
                    return (radiance, depth + 1);
                }
                throughput /= survival as f32;
            }
            drawn = draw.density;
            ray = Ray {
                origin: start,
                direction: draw.direction,
            };
            met = self.stage.closest(poses, &ray);
        }
        (radiance, MOST_BOUNCES)
    }

    fn has_lights(&self) -> bool {
        self.stage.scene.sun.is_some() || !self.emitters.is_empty()
    }

    /// Background and sun disc, weighted by whether light sampling could have found them.
    fn beyond(&self, ray: &Ray, drawn: Drawn) -> Vec3 {
        let scene = self.stage.scene;
        let weight = drawn.map_or(1.0, |drawn| {
            power_heuristic(drawn, self.stage.sky().density(ray.direction))
        });
        let background = scene.background.radiance(ray.direction) * weight as f32;
        match &scene.sun {
            Some(sun) if sun.covers(ray.direction) => {
                let weight = drawn.map_or(1.0, |drawn| power_heuristic(drawn, sun.density()));
                background + sun.radiance() * weight as f32
            }
            _ => background,
        }
    }

    /// A surface's own light, weighted by whether light sampling could have found it.
    fn emitted(&self, surface: &Surface, ray: &Ray, hit: &Hit, drawn: Drawn) -> Vec3 {
        if surface.emission == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let weight = drawn.map_or(1.0, |drawn| {
            let cosine = surface.facet.dot(ray.direction);
            let by_light = self.emitters.chance(hit.object, hit.triangle)
                * density_per_steradian(surface.area, hit.t, cosine);
            power_heuristic(drawn, by_light)
        });
        surface.emission * weight as f32
    }

    /// Light that comes straight from the sun and from one emitter, scattered by a surface. The random
    /// numbers choose the emitter, the point on it and the point on the sun.
    fn direct(
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
            light += self.arriving(poses, start, brdf, &sun.sample([sun_u, sun_v]), by_surface);
        }
        if let Some(drawn) = self.emitters.sample(scene, poses, start, choice, [u, v]) {
            light += self.arriving(poses, start, brdf, &drawn, true);
        }
        light
    }

    /// One light sample's contribution; `by_surface`: the surface might have drawn it too.
    fn arriving(
        &self,
        poses: &mut Poses,
        start: DVec3,
        brdf: &Brdf,
        light: &LightSample,
        by_surface: bool,
    ) -> Vec3 {
        let Scattered { share, density } = brdf.scattered(light.direction);
        if share == Vec3::ZERO || light.radiance == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let ray = Ray {
            origin: start,
            direction: light.direction,
        };
        // The light's own triangle lies at the end.
        let limit = light.distance * (1.0 - LIFT);
        if self.stage.blocked(poses, &ray, limit) {
            return Vec3::ZERO;
        }
        let weight = if by_surface {
            power_heuristic(light.density, density)
        } else {
            1.0
        };
        light.radiance * share * (weight / light.density) as f32
    }
}

/// The greatest length that went into a hit's position, metres.
fn magnitude(surface: &Surface, hit: &Hit) -> f64 {
    surface.position.abs().max_element().max(hit.t)
}
