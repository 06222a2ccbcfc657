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
    /// The BRDF of a surface of this colour, seen from a unit direction on its facet's side; none where it scatters nothing.
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

    /// Draws a direction from three numbers in [0, 1); none where the light is lost.
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
    use std::f64::consts::TAU;

    use super::*;
    use crate::scene::{Finish, Material};

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

    /// A direction at this cosine to +Z.
    fn at(cosine: f64) -> DVec3 {
        DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine)
    }

    fn make_brdf<'a>(
        material: &'a GlossyMaterial,
        color: Vec3,
        normal: DVec3,
        to_viewer: DVec3,
    ) -> Brdf<'a> {
        Brdf::new(Some(material), color, DVec3::Z, normal, to_viewer).expect("it scatters")
    }

    /// The midpoints of a grid over the square.
    fn grid(side: u32) -> impl Iterator<Item = [f64; 2]> {
        let middle = move |step: u32| (f64::from(step) + 0.5) / f64::from(side);
        (0..side * side).map(move |index| [middle(index % side), middle(index / side)])
    }

    /// The integrals over the hemisphere of scattered light and of the density.
    fn integral(brdf: &Brdf, weight: impl Fn(DVec3) -> f64) -> [f64; 2] {
        const SIDE: u32 = 800;
        let mut sums = [0.0; 2];
        for [height, turn] in grid(SIDE) {
            let (sine, cosine) = (TAU * turn).sin_cos();
            let radius = (1.0 - height * height).sqrt();
            let direction = DVec3::new(radius * cosine, radius * sine, height);
            let value = brdf.evaluate(direction);
            sums[0] += f64::from(value.scattered.x) * weight(direction);
            sums[1] += value.density * weight(direction);
        }
        sums.map(|sum| sum * TAU / f64::from(SIDE * SIDE))
    }

    #[test]
    fn nothing_gives_more_than_it_gets_and_darker_gives_less() {
        for finish in FINISHES {
            let material = glossy(finish);
            for cosine in [0.1, 0.5, 1.0] {
                let albedo = |color: f32| {
                    let color = Vec3::splat(color);
                    integral(&make_brdf(&material, color, DVec3::Z, at(cosine)), |_| 1.0)[0]
                };
                let levels = [0.0, 0.3, 0.7, 1.0].map(albedo);
                assert!(levels.is_sorted() && levels[0] > 0.0 && levels[3] < 1.003);
            }
        }
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
                let brdf = make_brdf(&material, color, DVec3::Z, to_viewer);
                brdf.evaluate(light).scattered / light.z as f32
            };
            let [there, back] = [scatter(a, b), scatter(b, a)];
            assert!(there.distance(back) < 1e-5 * there.length(), "{finish:?}");
        }
    }

    #[test]
    fn what_is_drawn_adds_up_to_what_is_scattered() {
        for finish in FINISHES {
            let material = glossy(finish);
            // The facet's own normal, one that leans, and one that a viewer sees from behind.
            for [normal, to_viewer] in [
                [DVec3::Z, at(0.6)],
                [at(0.8), DVec3::new(-0.5, 0.5, 0.7).normalize()],
                [at(0.3), DVec3::new(-0.9, 0.1, 0.2).normalize()],
            ] {
                let brdf = make_brdf(&material, Vec3::new(0.8, 0.4, 0.2), normal, to_viewer);
                let weight = |direction: DVec3| 1.0 + direction.x + 0.5 * direction.y * direction.z;
                let [scattered, density] = integral(&brdf, weight);
                let mut sampled = [0.0; 2];
                let choices = 40;
                for choice in (0..choices).map(|step| (f64::from(step) + 0.5) / f64::from(choices))
                {
                    for [u, v] in grid(100) {
                        if let Some(sample) = brdf.sample(choice, [u, v]) {
                            assert!(sample.direction.z >= 0.0 && sample.weight.is_finite());
                            sampled[0] += f64::from(sample.weight.x) * weight(sample.direction);
                            sampled[1] += weight(sample.direction);
                        }
                    }
                }
                let sampled = sampled.map(|sum| sum / (10_000.0 * f64::from(choices)));
                // Forty choices step over the border between both parts by at most 1/80.
                let error = (sampled[0] - scattered)
                    .abs()
                    .max((sampled[1] - density).abs());
                assert!(
                    error < 0.02,
                    "{finish:?} {normal}: {sampled:?} {scattered} {density}"
                );
            }
        }
    }
}
