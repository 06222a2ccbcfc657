//! Lights that are sampled directly: the sun and emissive triangles.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};
use scene::{Scene, Sun};

use crate::material::surface::{emission, find_material};
use crate::motion::poses::Poses;

/// A point sampled on a light, as seen from a surface.
pub(crate) struct LightSample {
    /// Unit vector to the point.
    pub direction: DVec3,
    /// Metres; infinite for the sun and the background.
    pub distance: f64,
    /// Radiance that arrives if nothing is in between.
    pub radiance: Vec3,
    /// Probability per steradian of having sampled this direction.
    pub density: f64,
}

/// Probability per steradian of a point sampled uniformly on an area, seen at a distance and a
/// cosine.
pub(crate) fn density_per_steradian(area: f64, distance: f64, cosine: f64) -> f64 {
    distance * distance / (area * cosine.abs())
}

/// Weight of a sample of one density that a strategy of the density `other` might have drawn as
/// well: the power heuristic (Veach 1997, section 9.2).
pub(crate) fn power_heuristic(density: f64, other: f64) -> f64 {
    let ratio = other / density;
    1.0 / (1.0 + ratio * ratio)
}

/// All emissive triangles, sampled in proportion to their area and emission at one reference time.
pub(crate) struct Emitters {
    /// Object and triangle of each.
    pub triangles: Vec<(usize, u32)>,
    /// Sums of the chances up to each triangle, rising to 1.
    cumulative: Vec<f64>,
    /// Chance of being sampled, per object and triangle; empty for objects that do not emit.
    chances: Vec<Vec<f64>>,
}

impl Emitters {
    /// Collects the emitters of a scene, weighted by their areas at the time of `poses`.
    pub fn new(scene: &Scene, poses: &mut Poses) -> Self {
        let mut triangles = Vec::new();
        let mut weights = Vec::new();
        for (object, shown) in scene.objects.iter().enumerate() {
            let mesh = &scene.meshes[shown.mesh];
            for triangle in 0..mesh.triangles.len() as u32 {
                let strength = find_material(scene, object, triangle)
                    .emission
                    .max_element();
                let shape = mesh.at(poses.time());
                let normal = shape.area_normal(triangle, &poses.pose(object).to_world);
                let weight = f64::from(strength) * (0.5 * normal.length());
                if weight > 0.0 {
                    triangles.push((object, triangle));
                    weights.push(weight);
                }
            }
        }
        let total: f64 = weights.iter().sum();
        let mut chances: Vec<Vec<f64>> = vec![Vec::new(); scene.objects.len()];
        let mut cumulative = Vec::with_capacity(weights.len());
        let mut sum = 0.0;
        for (&(object, triangle), weight) in triangles.iter().zip(&weights) {
            let of_object = &mut chances[object];
            if of_object.is_empty() {
                of_object.resize(
                    scene.meshes[scene.objects[object].mesh].triangles.len(),
                    0.0,
                );
            }
            of_object[triangle as usize] = weight / total;
            sum += weight;
            cumulative.push(sum / total);
        }
        Self {
            triangles,
            cumulative,
            chances,
        }
    }

    /// Draws a point on an emitter from three numbers in [0, 1), as seen from `from`; none if the
    /// sampled triangle is seen edge-on, or nothing emits.
    pub fn sample(
        &self,
        scene: &Scene,
        poses: &mut Poses,
        from: DVec3,
        choice: f64,
        [u, v]: [f64; 2],
    ) -> Option<LightSample> {
        let last = self.triangles.len().checked_sub(1)?;
        let chosen = self.cumulative.partition_point(|&sum| sum <= choice);
        let (object, triangle) = self.triangles[chosen.min(last)];
        let mesh = &scene.meshes[scene.objects[object].mesh];
        let shape = mesh.at(poses.time());
        // The square's upper half is folded onto the triangle.
        let weights = if u + v > 1.0 {
            [1.0 - u, 1.0 - v]
        } else {
            [u, v]
        };
        let to_world = poses.pose(object).to_world;
        let point = to_world.transform_point3(shape.point(triangle, weights));
        let way = point - from;
        let distance = way.length();
        let direction = way / distance;
        let scaled = shape.area_normal(triangle, &to_world);
        let density = self.chance(object, triangle)
            * density_per_steradian(
                0.5 * scaled.length(),
                distance,
                direction.dot(scaled.normalize_or_zero()),
            );
        density.is_finite().then(|| LightSample {
            direction,
            distance,
            radiance: emission(scene, object, triangle, weights),
            density,
        })
    }

    /// The probability of drawing this triangle.
    pub fn chance(&self, object: usize, triangle: u32) -> f64 {
        self.chances[object]
            .get(triangle as usize)
            .copied()
            .unwrap_or(0.0)
    }
}

/// Draws a direction to the sun from two numbers in [0, 1). A point sun has a density of 1 and
/// its irradiance as radiance, since nothing else can draw it.
pub(crate) fn sample_sun(sun: &Sun, [u, v]: [f64; 2]) -> LightSample {
    let direction = if sun.angular_radius == 0.0 {
        sun.direction
    } else {
        let cosine = 1.0 - u * sun.cap();
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let (y, x) = (TAU * v).sin_cos();
        let (tangent, bitangent) = sun.direction.any_orthonormal_pair();
        sine * x * tangent + sine * y * bitangent + cosine * sun.direction
    };
    LightSample {
        direction,
        distance: f64::INFINITY,
        radiance: sun.radiance(),
        density: sun_density(sun),
    }
}

/// The probability per steradian with which [`sample_sun`] draws a direction inside the disc.
pub(crate) fn sun_density(sun: &Sun) -> f64 {
    if sun.angular_radius == 0.0 {
        1.0
    } else {
        1.0 / (TAU * sun.cap())
    }
}
