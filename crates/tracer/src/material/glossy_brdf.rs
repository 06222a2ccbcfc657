//! The BRDF of a glossy surface point.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3, Vec3};

use crate::material::brdf_sample::{BrdfSample, BrdfValue};
use crate::material::fresnel;
use crate::material::ggx::reflect;
use crate::material::glossy_material::GlossyMaterial;

/// Least cosine between a shading normal and the viewer; normals are bent to reach it.
const LOWEST_VIEW: f64 = 0.01;

/// Microfacets, over a second lobe for the light that a single reflection does not return: light
/// between the facets of a metal, or below a coat.
///
/// With the microfacets' albedo E, the second lobe is (1 - E(out)) (1 - E(in)) / (pi (1 - mean E)).
/// It is reciprocal and adds up to all that is missing (Kulla and Conty 2017, "Revisiting
/// Physically Based Shading at Imageworks"). Light that an interpolated normal sends below the
/// facet is mirrored at it, as in [`DiffuseLobe`](crate::material::diffuse_lobe::DiffuseLobe).
pub(crate) struct GlossyBrdf<'a> {
    material: &'a GlossyMaterial,
    facet: DVec3,
    /// Transform to the world from the space whose +Z is the shading normal.
    to_world: DMat3,
    /// Direction to the viewer, in the shading normal's space.
    outgoing: DVec3,
    /// Reflectance of the metal at normal incidence; unused under a coat.
    metal: Vec3,
    /// Colour of the second lobe.
    rest: Vec3,
    /// Factor of the second lobe: (1 - E(out)) / (pi (1 - mean E)).
    rest_factor: f64,
    /// Probability of sampling the microfacets, not the second lobe.
    facet_chance: f64,
}

impl<'a> GlossyBrdf<'a> {
    pub fn new(
        material: &'a GlossyMaterial,
        color: Vec3,
        facet: DVec3,
        normal: DVec3,
        to_viewer: DVec3,
    ) -> Self {
        let normal = bend_normal(normal, to_viewer);
        let (tangent, bitangent) = normal.any_orthonormal_pair();
        let to_world = DMat3::from_cols(tangent, bitangent, normal);
        let outgoing = to_world.transpose() * to_viewer;
        let [given, mean] = [material.albedo.at(outgoing.z), material.albedo.mean];
        let (rest, reflectance) = match material.coat {
            Some(_) => (color, 1.0),
            None => {
                let fresnel = fresnel::mean_conductor(color);
                (interreflection(fresnel, mean), fresnel.max_element())
            }
        };
        let by_facets = f64::from(reflectance) * given;
        let by_rest = f64::from(rest.max_element()) * (1.0 - given);
        Self {
            material,
            facet,
            to_world,
            outgoing,
            metal: color,
            rest,
            // A mirror leaves nothing for the second lobe.
            rest_factor: if mean < 1.0 {
                (1.0 - given) / (PI * (1.0 - mean))
            } else {
                0.0
            },
            facet_chance: by_facets / (by_facets + by_rest),
        }
    }

    /// Evaluates the light from a unit direction.
    pub fn evaluate(&self, direction: DVec3) -> BrdfValue {
        let above = direction.dot(self.facet);
        if above <= 0.0 {
            return BrdfValue::ZERO;
        }
        let mirrored = direction - 2.0 * above * self.facet;
        let [value, mirrored_value] =
            [direction, mirrored].map(|direction| self.evaluate_unmirrored(direction));
        BrdfValue {
            scattered: value.scattered + mirrored_value.scattered,
            density: value.density + mirrored_value.density,
        }
    }

    /// Evaluates both lobes as if the shading normal were the facet's.
    fn evaluate_unmirrored(&self, direction: DVec3) -> BrdfValue {
        let incoming = self.to_world.transpose() * direction;
        if incoming.z <= 0.0 {
            return BrdfValue::ZERO;
        }
        let rest = self.rest_factor * (1.0 - self.material.albedo.at(incoming.z)) * incoming.z;
        let mut value = BrdfValue {
            scattered: self.rest * rest as f32,
            density: (1.0 - self.facet_chance) * incoming.z / PI,
        };
        if let Some(facets) = &self.material.facets {
            let reflection = facets.evaluate(self.outgoing, incoming);
            value.scattered += self.reflectance(reflection.cosine) * reflection.scattered as f32;
            value.density += self.facet_chance * reflection.density;
        }
        value
    }

    /// Draws a direction from three numbers in [0, 1); none if the light is lost.
    pub fn sample(&self, choice: f64, [u, v]: [f64; 2]) -> Option<BrdfSample> {
        if choice >= self.facet_chance {
            let radius = u.sqrt();
            let (sine, cosine) = (TAU * v).sin_cos();
            let incoming = DVec3::new(radius * cosine, radius * sine, (1.0 - u).sqrt());
            return self.sample_at(self.mirror_up(incoming));
        }
        match &self.material.facets {
            Some(facets) => {
                let normal = facets.sample(self.outgoing, [u, v]);
                let incoming = reflect(self.outgoing, normal);
                // Light below the surface is lost: the albedo table lacks it too.
                (incoming.z > 0.0).then(|| self.sample_at(self.mirror_up(incoming)))?
            }
            None => Some(BrdfSample {
                direction: self.mirror_up(reflect(self.outgoing, DVec3::Z)),
                weight: self.reflectance(self.outgoing.z) / self.facet_chance as f32,
                density: None,
            }),
        }
    }

    /// The sample of a direction; none for a direction along the facet itself.
    fn sample_at(&self, direction: DVec3) -> Option<BrdfSample> {
        let BrdfValue { scattered, density } = self.evaluate(direction);
        (density > 0.0).then(|| BrdfSample {
            direction,
            weight: scattered / density as f32,
            density: Some(density),
        })
    }

    fn reflectance(&self, cosine: f64) -> Vec3 {
        match self.material.coat {
            Some(index) => Vec3::splat(fresnel::dielectric(index, cosine) as f32),
            None => fresnel::conductor(self.metal, cosine),
        }
    }

    /// Turns a direction into the world and mirrors it to the facet's side.
    fn mirror_up(&self, incoming: DVec3) -> DVec3 {
        let direction = self.to_world * incoming;
        direction + 2.0 * (-direction.dot(self.facet)).max(0.0) * self.facet
    }
}

/// The colour of light that leaves a metal after two or more reflections between its facets, over
/// the light that did not leave after one. It follows from the facets' mean reflectance and the
/// mean albedo of a single reflection of everything.
fn interreflection(reflectance: Vec3, albedo: f64) -> Vec3 {
    let albedo = albedo as f32;
    reflectance * reflectance * albedo / (Vec3::ONE - reflectance * (1.0 - albedo))
}

/// Bends a normal towards a viewer who would see it from behind.
fn bend_normal(normal: DVec3, to_viewer: DVec3) -> DVec3 {
    let lacking = LOWEST_VIEW - normal.dot(to_viewer);
    if lacking > 0.0 {
        (normal + lacking * to_viewer).normalize()
    } else {
        normal
    }
}
