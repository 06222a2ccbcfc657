//! Glossy materials: microfacets and the table of their albedo.

use scene::{Finish, Material};

use crate::material::fresnel;
use crate::material::ggx::Ggx;

/// Cosines at which the albedo is tabulated, 0 and 1 included, denser towards grazing angles.
const COSINES: usize = 129;
/// Cosine used for 0, at which no surface is seen.
const GRAZING: f64 = 1e-6;

/// A glossy material, prepared for all its points.
#[derive(Clone, Debug)]
pub(crate) struct GlossyMaterial {
    /// Microfacets; none for a mirror.
    pub facets: Option<Ggx>,
    /// Index of refraction of a coat; none for bare metal.
    pub coat: Option<f64>,
    pub albedo: AlbedoTable,
}

/// The share of light that one reflection returns, by the cosine. A coat has its own reflectance; a
/// metal is tabulated as if it reflected everything.
#[derive(Clone, Debug)]
pub(crate) struct AlbedoTable {
    /// Shares at cosines that are the squares of equal steps.
    nodes: Vec<f64>,
    /// Mean over the hemisphere, weighted by the cosine.
    pub mean: f64,
}

impl GlossyMaterial {
    /// Prepares a material; none for a diffuse one.
    pub fn new(material: &Material) -> Option<Self> {
        let (roughness, coat) = match material.finish {
            Finish::Diffuse => return None,
            Finish::Conductor { roughness } => (roughness, None),
            Finish::Coated { roughness, index } => (roughness, Some(f64::from(index))),
        };
        let alpha = f64::from(roughness) * f64::from(roughness);
        let facets = (alpha > 0.0).then_some(Ggx { alpha });
        let reflectance =
            |cosine: f64| coat.map_or(1.0, |index| fresnel::dielectric(index, cosine));
        let albedo = AlbedoTable::tabulate(|cosine| match facets {
            None => reflectance(cosine),
            Some(facets) => facets.albedo(cosine, reflectance),
        });
        Some(Self {
            facets,
            coat,
            albedo,
        })
    }
}

impl AlbedoTable {
    fn tabulate(albedo: impl Fn(f64) -> f64) -> Self {
        let steps = (COSINES - 1) as f64;
        let nodes: Vec<f64> = (0..COSINES)
            .map(|node| (node as f64 / steps).powi(2))
            .map(|cosine| albedo(cosine.max(GRAZING)))
            .collect();
        // With s = sqrt(cosine) the weight is 4 s^3 ds, and the albedo a + b s between nodes.
        let mean = nodes.windows(2).enumerate().map(|(node, ends)| {
            let [from, to] = [node, node + 1].map(|node| node as f64 / steps);
            let slope = (ends[1] - ends[0]) * steps;
            let start = ends[0] - slope * from;
            start * (to.powi(4) - from.powi(4)) + 0.8 * slope * (to.powi(5) - from.powi(5))
        });
        let mean = mean.sum();
        Self { nodes, mean }
    }

    /// The share for a direction at this cosine to the normal.
    pub fn at(&self, cosine: f64) -> f64 {
        let place = cosine.clamp(0.0, 1.0).sqrt() * (COSINES - 1) as f64;
        let node = (place as usize).min(COSINES - 2);
        self.nodes[node] + (place - node as f64) * (self.nodes[node + 1] - self.nodes[node])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_right_between_its_nodes() {
        for alpha in [0.01, 0.1, 0.5, 1.0] {
            let facets = Ggx { alpha };
            let table = AlbedoTable::tabulate(|cosine| facets.albedo(cosine, |_| 1.0));
            for cosine in [0.003, 0.03, 0.2, 0.55, 0.97] {
                let exact = facets.albedo(cosine, |_| 1.0);
                let error = (table.at(cosine) - exact).abs();
                assert!(error < 1e-3, "{alpha} {cosine}: {error}");
            }
        }
    }

    #[test]
    fn the_mean_is_that_of_the_interpolated_table() {
        let table = AlbedoTable::tabulate(|cosine| 1.0 - 0.5 * cosine);
        let steps = 100_000;
        let sum: f64 = (0..steps)
            .map(|step| (f64::from(step) + 0.5) / f64::from(steps))
            .map(|cosine| 2.0 * cosine * table.at(cosine) / f64::from(steps))
            .sum();
        assert!((table.mean - sum).abs() < 1e-9, "{} {sum}", table.mean);
    }
}
