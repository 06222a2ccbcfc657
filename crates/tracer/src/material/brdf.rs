//! The BRDF of a surface point, seen from one direction.

use glam::{DVec3, Vec3};

use crate::material::brdf_sample::{BrdfSample, BrdfValue};
use crate::material::diffuse_lobe::DiffuseLobe;
use crate::material::glossy_brdf::GlossyBrdf;
use crate::material::glossy_material::GlossyMaterial;

/// A surface that scatters light to one viewer.
pub(crate) enum Brdf<'a> {
    Diffuse { lobe: DiffuseLobe, albedo: Vec3 },
    Glossy(GlossyBrdf<'a>),
}

impl<'a> Brdf<'a> {
    /// The BRDF of a surface of this colour, seen from a unit direction on its facet's side; none
    /// if it scatters nothing.
    pub fn new(
        glossy: Option<&'a GlossyMaterial>,
        color: Vec3,
        facet: DVec3,
        normal: DVec3,
        to_viewer: DVec3,
    ) -> Option<Self> {
        match glossy {
            Some(material) => Some(Brdf::Glossy(GlossyBrdf::new(
                material, color, facet, normal, to_viewer,
            ))),
            None if color == Vec3::ZERO => None,
            None => Some(Brdf::Diffuse {
                lobe: DiffuseLobe::new(facet, normal),
                albedo: color,
            }),
        }
    }

    /// Evaluates the light from a unit direction. The single direction of a mirror is left out.
    pub fn evaluate(&self, direction: DVec3) -> BrdfValue {
        match self {
            Brdf::Diffuse { lobe, albedo } => {
                let density = lobe.density(direction);
                BrdfValue {
                    scattered: *albedo * density as f32,
                    density,
                }
            }
            Brdf::Glossy(glossy) => glossy.evaluate(direction),
        }
    }

    /// Draws a direction from three numbers in [0, 1); none if the light is lost.
    pub fn sample(&self, choice: f64, [u, v]: [f64; 2]) -> Option<BrdfSample> {
        match self {
            Brdf::Diffuse { lobe, albedo } => {
                let direction = lobe.sample(u, v);
                Some(BrdfSample {
                    direction,
                    weight: *albedo,
                    density: Some(lobe.density(direction)),
                })
            }
            Brdf::Glossy(glossy) => glossy.sample(choice, [u, v]),
        }
    }
}

#[cfg(test)]
mod tests {
    use scene::{Finish, Material};

    use super::*;

    const FINISHES: [Finish; 6] = [
        Finish::Conductor { roughness: 0.3 },
        Finish::Conductor { roughness: 0.6 },
        Finish::Conductor { roughness: 1.0 },
        Finish::Coated {
            roughness: 0.3,
            index: 1.5,
        },
        Finish::Coated {
            roughness: 0.7,
            index: 1.5,
        },
        Finish::Coated {
            roughness: 1.0,
            index: 2.4,
        },
    ];

    fn glossy(finish: Finish) -> GlossyMaterial {
        let material = Material {
            finish,
            diffuse: Vec3::ONE,
            ..Material::default()
        };
        GlossyMaterial::new(&material).expect("it is glossy")
    }

    #[test]
    fn light_goes_both_ways_alike() {
        for finish in FINISHES {
            let material = glossy(finish);
            let [a, b] = [
                DVec3::new(0.5, 0.2, 0.4).normalize(),
                DVec3::new(-0.7, 0.1, 0.3).normalize(),
            ];
            let color = Vec3::new(0.9, 0.5, 0.1);
            let scatter = |to_viewer: DVec3, light: DVec3| {
                let brdf = Brdf::new(Some(&material), color, DVec3::Z, DVec3::Z, to_viewer);
                let brdf = brdf.expect("it scatters");
                brdf.evaluate(light).scattered / light.z as f32
            };
            let [there, back] = [scatter(a, b), scatter(b, a)];
            assert!(there.distance(back) < 1e-5 * there.length(), "{finish:?}");
        }
    }
}
