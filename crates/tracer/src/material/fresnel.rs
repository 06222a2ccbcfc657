//! Fresnel reflectance of dielectrics and metals.

use glam::Vec3;

/// The reflectance of a smooth dielectric for unpolarised light from outside (Fresnel's equations).
/// The index of refraction is at least 1.
pub(crate) fn dielectric(index: f64, cosine: f64) -> f64 {
    let inside = (1.0 - (1.0 - cosine * cosine) / (index * index)).sqrt();
    let across = (cosine - index * inside) / (cosine + index * inside);
    let along = (index * cosine - inside) / (index * cosine + inside);
    0.5 * (across * across + along * along)
}

/// The reflectance of a metal, from its reflectance at normal incidence (Schlick 1994, equation
/// 15).
pub(crate) fn conductor(normal_incidence: Vec3, cosine: f64) -> Vec3 {
    let grazing = (1.0 - cosine).clamp(0.0, 1.0).powi(5) as f32;
    normal_incidence + grazing * (Vec3::ONE - normal_incidence)
}

/// The mean of [`conductor`] over the hemisphere, weighted by the cosine.
pub(crate) fn mean_conductor(normal_incidence: Vec3) -> Vec3 {
    normal_incidence + (Vec3::ONE - normal_incidence) / 21.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_metal_s_mean_is_the_integral_of_its_angles() {
        let gold = Vec3::new(1.0, 0.71, 0.29);
        let steps = 2000;
        let mean: Vec3 = (0..steps)
            .map(|step| (f64::from(step) + 0.5) / f64::from(steps))
            .map(|cosine| 2.0 * cosine as f32 * conductor(gold, cosine) / steps as f32)
            .sum();
        assert!(mean.distance(mean_conductor(gold)) < 1e-5);
    }
}
