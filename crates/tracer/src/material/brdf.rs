//! How a point of a surface scatters light.

use glam::{DVec3, Vec3};

use crate::material::diffuse_lobe::Lobe;
use crate::material::glossy_brdf::Glossy;
use crate::material::glossy_material::Gloss;

/// A surface that scatters towards one direction.
pub(crate) enum Brdf<'a> {
    Diffuse { lobe: Lobe, albedo: Vec3 },
    Glossy(Glossy<'a>),
}

/// What a surface sends on of the light from one direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scattered {
    /// Radiance per radiance arriving per steradian, cosine included.
    pub share: Vec3,
    /// Probability per steradian with which [`Brdf::sample`] draws that direction.
    pub density: f64,
}

/// A drawn direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Draw {
    /// Unit, on the facet's side.
    pub direction: DVec3,
    /// What is sent on of the radiance from there, over the density.
    pub weight: Vec3,
    /// Probability per steradian; none for a mirror's one direction, which nothing else can draw.
    pub density: Option<f64>,
}

impl<'a> Brdf<'a> {
    /// A surface of this colour seen from a unit direction on its facet's side; none where it scatters nothing.
    pub fn new(
        gloss: Option<&'a Gloss>,
        color: Vec3,
        facet: DVec3,
        normal: DVec3,
        to_viewer: DVec3,
    ) -> Option<Self> {
        match gloss {
            Some(gloss) => Some(Brdf::Glossy(Glossy::new(
                gloss, color, facet, normal, to_viewer,
            ))),
            None if color == Vec3::ZERO => None,
            None => Some(Brdf::Diffuse {
                lobe: Lobe::new(facet, normal),
                albedo: color,
            }),
        }
    }

    /// What is sent to the viewer of the light from a unit direction, without what only a mirror sends.
    pub fn scattered(&self, direction: DVec3) -> Scattered {
        match self {
            Brdf::Diffuse { lobe, albedo } => {
                let density = lobe.density(direction);
                Scattered {
                    share: *albedo * density as f32,
                    density,
                }
            }
            Brdf::Glossy(glossy) => glossy.scattered(direction),
        }
    }

    /// A direction from three numbers in [0, 1); none where the light is lost.
    pub fn sample(&self, choice: f64, [u, v]: [f64; 2]) -> Option<Draw> {
        match self {
            Brdf::Diffuse { lobe, albedo } => {
                let direction = lobe.sample(u, v);
                Some(Draw {
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
    use crate::material::fresnel;
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

    fn gloss(finish: Finish) -> Gloss {
        let material = Material {
            name: "made by a test".into(),
            finish,
            diffuse: Vec3::ONE,
            diffuse_texture: None,
            emission: Vec3::ZERO,
            emission_texture: None,
            opacity: 1.0,
            opacity_texture: None,
        };
        Gloss::of(&material).expect("it is glossy")
    }

    /// A direction at this cosine to +Z.
    fn at(cosine: f64) -> DVec3 {
        DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine)
    }

    fn seen<'a>(gloss: &'a Gloss, color: Vec3, normal: DVec3, to_viewer: DVec3) -> Brdf<'a> {
        Brdf::new(Some(gloss), color, DVec3::Z, normal, to_viewer).expect("it scatters")
    }

    /// The midpoints of a grid over the square.
    fn grid(side: u32) -> impl Iterator<Item = [f64; 2]> {
        let middle = move |step: u32| (f64::from(step) + 0.5) / f64::from(side);
        (0..side * side).map(move |index| [middle(index % side), middle(index / side)])
    }

    /// The integral over the hemisphere of what is scattered, and of the density.
    fn integral(brdf: &Brdf, weight: impl Fn(DVec3) -> f64) -> [f64; 2] {
        const SIDE: u32 = 800;
        let mut sums = [0.0; 2];
        for [height, turn] in grid(SIDE) {
            let (sine, cosine) = (TAU * turn).sin_cos();
            let radius = (1.0 - height * height).sqrt();
            let direction = DVec3::new(radius * cosine, radius * sine, height);
            let scattered = brdf.scattered(direction);
            sums[0] += f64::from(scattered.share.x) * weight(direction);
            sums[1] += scattered.density * weight(direction);
        }
        sums.map(|sum| sum * TAU / f64::from(SIDE * SIDE))
    }

    #[test]
    fn white_gives_everything_back() {
        for finish in FINISHES {
            let gloss = gloss(finish);
            for cosine in [0.1, 0.4, 0.8, 1.0] {
                let brdf = seen(&gloss, Vec3::ONE, DVec3::Z, at(cosine));
                let [albedo, _] = integral(&brdf, |_| 1.0);
                // The midpoint rule's error at grazing angles, beside the table's.
                let error = (albedo - 1.0).abs();
                assert!(error < 3e-3, "{finish:?} at {cosine}: {albedo}");
            }
        }
    }

    #[test]
    fn nothing_gives_more_than_it_gets_and_darker_gives_less() {
        for finish in FINISHES {
            let gloss = gloss(finish);
            for cosine in [0.1, 0.5, 1.0] {
                let albedo = |color: f32| {
                    let color = Vec3::splat(color);
                    integral(&seen(&gloss, color, DVec3::Z, at(cosine)), |_| 1.0)[0]
                };
                let levels = [0.0, 0.3, 0.7, 1.0].map(albedo);
                assert!(levels.is_sorted() && levels[0] > 0.0 && levels[3] < 1.003);
            }
        }
    }

    #[test]
    fn light_goes_both_ways_alike() {
        for finish in FINISHES {
            let gloss = gloss(finish);
            let [a, b] = [
                DVec3::new(0.5, 0.2, 0.4).normalize(),
                DVec3::new(-0.7, 0.1, 0.3).normalize(),
            ];
            let color = Vec3::new(0.9, 0.5, 0.1);
            let there = seen(&gloss, color, DVec3::Z, a).scattered(b).share / b.z as f32;
            let back = seen(&gloss, color, DVec3::Z, b).scattered(a).share / a.z as f32;
            assert!(there.distance(back) < 1e-5 * there.length(), "{finish:?}");
        }
    }

    #[test]
    fn what_is_drawn_adds_up_to_what_is_scattered() {
        for finish in FINISHES {
            let gloss = gloss(finish);
            // The facet's own normal, one that leans, and one that a viewer sees from behind.
            for [normal, to_viewer] in [
                [DVec3::Z, at(0.6)],
                [at(0.8), DVec3::new(-0.5, 0.5, 0.7).normalize()],
                [at(0.3), DVec3::new(-0.9, 0.1, 0.2).normalize()],
            ] {
                let brdf = seen(&gloss, Vec3::new(0.8, 0.4, 0.2), normal, to_viewer);
                let weight = |direction: DVec3| 1.0 + direction.x + 0.5 * direction.y * direction.z;
                let [scattered, density] = integral(&brdf, weight);
                let mut drawn = [0.0; 2];
                let choices = 40;
                for choice in (0..choices).map(|step| (f64::from(step) + 0.5) / f64::from(choices))
                {
                    for [u, v] in grid(100) {
                        if let Some(draw) = brdf.sample(choice, [u, v]) {
                            assert!(draw.direction.z >= 0.0 && draw.weight.is_finite());
                            drawn[0] += f64::from(draw.weight.x) * weight(draw.direction);
                            drawn[1] += weight(draw.direction);
                        }
                    }
                }
                let drawn = drawn.map(|sum| sum / (10_000.0 * f64::from(choices)));
                // Forty choices step over the border between both parts by at most 1/80.
                let error = (drawn[0] - scattered).abs().max((drawn[1] - density).abs());
                assert!(
                    error < 0.02,
                    "{finish:?} {normal}: {drawn:?} {scattered} {density}"
                );
            }
        }
    }

    #[test]
    fn a_smooth_coat_reflects_by_fresnel_and_the_base_gives_the_rest() {
        let gloss = gloss(Finish::Coated {
            roughness: 0.0,
            index: 1.5,
        });
        for cosine in [0.05, 0.3, 1.0] {
            let brdf = seen(&gloss, Vec3::ONE, DVec3::Z, at(cosine));
            let mirror = brdf.sample(0.0, [0.3, 0.3]).expect("it reflects");
            assert!(mirror.density.is_none());
            assert!(
                mirror
                    .direction
                    .distance(at(cosine) * DVec3::new(-1.0, 1.0, 1.0))
                    < 1e-12
            );
            let [base, by_base] = integral(&brdf, |_| 1.0);
            let reflected = f64::from(mirror.weight.x) * (1.0 - by_base);
            let exact = fresnel::dielectric(1.5, cosine);
            assert!((reflected - exact).abs() < 1e-6, "{reflected} {exact}");
            // The table's error.
            assert!((base + reflected - 1.0).abs() < 1e-3, "{cosine}: {base}");
        }
    }
}
