//! How a point of a glossy surface scatters light.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3, Vec3};

use crate::material::brdf::{Draw, Scattered};
use crate::material::fresnel;
use crate::material::ggx::mirrored;
use crate::material::glossy_material::Gloss;

/// Shading normals are bent so that the viewer stands at least this far above them, as a cosine.
const LOWEST_VIEW: f64 = 0.01;

/// Microfacets over what their single reflections leave: between the facets of a metal, or below a coat.
///
/// That rest is spread by the microfacets' albedo E as (1 - E(out)) (1 - E(in)) / (pi (1 - mean E)), which is reciprocal and adds
/// up to all that is missing (Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks"). Where an
/// interpolated normal sends light below the facet, it is folded up at it, as in a diffuse [`crate::material::diffuse_lobe::Lobe`].
pub(crate) struct Glossy<'a> {
    gloss: &'a Gloss,
    facet: DVec3,
    /// From the shading normal's space, whose +Z it is, to the world.
    to_world: DMat3,
    /// Towards the viewer, in the shading normal's space.
    outgoing: DVec3,
    /// Reflectance of the metal at normal incidence; of no meaning under a coat.
    metal: Vec3,
    /// Colour of the rest.
    rest: Vec3,
    /// Of the rest, (1 - E(out)) / (pi (1 - mean E)).
    left: f64,
    /// Probability of drawing the microfacets, not the rest.
    by_facets: f64,
}

impl<'a> Glossy<'a> {
    pub fn new(
        gloss: &'a Gloss,
        color: Vec3,
        facet: DVec3,
        normal: DVec3,
        to_viewer: DVec3,
    ) -> Self {
        let normal = bent(normal, to_viewer);
        let (tangent, bitangent) = normal.any_orthonormal_pair();
        let to_world = DMat3::from_cols(tangent, bitangent, normal);
        let outgoing = to_world.transpose() * to_viewer;
        let [given, mean] = [gloss.albedo.at(outgoing.z), gloss.albedo.mean];
        let (rest, reflectance) = match gloss.coat {
            Some(_) => (color, 1.0),
            None => {
                let fresnel = fresnel::mean_conductor(color);
                (between_facets(fresnel, mean), fresnel.max_element())
            }
        };
        let by_facets = f64::from(reflectance) * given;
        let by_rest = f64::from(rest.max_element()) * (1.0 - given);
        Self {
            gloss,
            facet,
            to_world,
            outgoing,
            metal: color,
            rest,
            // A mirror leaves nothing over.
            left: if mean < 1.0 {
                (1.0 - given) / (PI * (1.0 - mean))
            } else {
                0.0
            },
            by_facets: by_facets / (by_facets + by_rest),
        }
    }

    /// What is sent to the viewer of the light from a unit direction.
    pub fn scattered(&self, direction: DVec3) -> Scattered {
        let above = direction.dot(self.facet);
        if above <= 0.0 {
            return Scattered {
                share: Vec3::ZERO,
                density: 0.0,
            };
        }
        let folded = direction - 2.0 * above * self.facet;
        let [own, below] = [direction, folded].map(|direction| self.unfolded(direction));
        Scattered {
            share: own.share + below.share,
            density: own.density + below.density,
        }
    }

    /// As if the shading normal were the facet's.
    fn unfolded(&self, direction: DVec3) -> Scattered {
        let incoming = self.to_world.transpose() * direction;
        if incoming.z <= 0.0 {
            return Scattered {
                share: Vec3::ZERO,
                density: 0.0,
            };
        }
        let left = self.left * (1.0 - self.gloss.albedo.at(incoming.z)) * incoming.z;
        let mut scattered = Scattered {
            share: self.rest * left as f32,
            density: (1.0 - self.by_facets) * incoming.z / PI,
        };
        if let Some(facets) = &self.gloss.facets {
            let reflection = facets.reflection(self.outgoing, incoming);
            scattered.share += self.reflectance(reflection.cosine) * reflection.scattered as f32;
            scattered.density += self.by_facets * reflection.density;
        }
        scattered
    }

    /// A direction from three numbers in [0, 1); none where the light is lost.
    pub fn sample(&self, choice: f64, [u, v]: [f64; 2]) -> Option<Draw> {
        if choice >= self.by_facets {
            let radius = u.sqrt();
            let (sine, cosine) = (TAU * v).sin_cos();
            let incoming = DVec3::new(radius * cosine, radius * sine, (1.0 - u).sqrt());
            return self.draw(self.folded(incoming));
        }
        match &self.gloss.facets {
            Some(facets) => {
                let normal = facets.sample(self.outgoing, [u, v]);
                let incoming = mirrored(self.outgoing, normal);
                // Below the surface: what the table says is missing.
                (incoming.z > 0.0).then(|| self.draw(self.folded(incoming)))?
            }
            None => Some(Draw {
                direction: self.folded(mirrored(self.outgoing, DVec3::Z)),
                weight: self.reflectance(self.outgoing.z) / self.by_facets as f32,
                density: None,
            }),
        }
    }

    /// None for a direction along the facet itself.
    fn draw(&self, direction: DVec3) -> Option<Draw> {
        let Scattered { share, density } = self.scattered(direction);
        (density > 0.0).then(|| Draw {
            direction,
            weight: share / density as f32,
            density: Some(density),
        })
    }

    fn reflectance(&self, cosine: f64) -> Vec3 {
        match self.gloss.coat {
            Some(index) => Vec3::splat(fresnel::dielectric(index, cosine) as f32),
            None => fresnel::conductor(self.metal, cosine),
        }
    }

    /// In the world, on the facet's side.
    fn folded(&self, incoming: DVec3) -> DVec3 {
        let direction = self.to_world * incoming;
        direction + 2.0 * (-direction.dot(self.facet)).max(0.0) * self.facet
    }
}

/// Colour of the light that a metal's facets send to one another, by their mean reflectance and the mean albedo of
/// reflecting everything once: what gets out after two reflections, three and so on, over what did not get out after one.
fn between_facets(reflectance: Vec3, albedo: f64) -> Vec3 {
    let albedo = albedo as f32;
    reflectance * reflectance * albedo / (Vec3::ONE - reflectance * (1.0 - albedo))
}

/// The normal, raised towards a viewer who would see it from behind.
fn bent(normal: DVec3, to_viewer: DVec3) -> DVec3 {
    let lacking = LOWEST_VIEW - normal.dot(to_viewer);
    if lacking > 0.0 {
        (normal + lacking * to_viewer).normalize()
    } else {
        normal
    }
}
