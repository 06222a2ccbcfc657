//! Weights of FLIP's filters at 67.02 pixels per degree.

use std::f32::consts::PI;

/// Pixels per degree of a monitor 0.7 m wide with 3840 pixels, from 0.7 m away.
const PIXELS_PER_DEGREE: f32 = 0.7 * (3840.0 / 0.7) * (PI / 180.0);

/// Weights of every separable filter, from the first pixel to the last; all have odd lengths.
pub struct Weights {
    /// Contrast sensitivity to lightness, to red and green, and twice to blue and yellow, whose two
    /// parts add up.
    pub contrast: [Vec<f32>; 4],
    /// Gaussian, and its first and second derivative, which find edges and points.
    pub feature: [Vec<f32>; 3],
}

impl Weights {
    /// Computes the weights as the tool does, in 32 bits and its order.
    pub fn new() -> Self {
        Self {
            contrast: compute_contrast_weights(),
            feature: compute_feature_weights(),
        }
    }
}

fn compute_contrast_weights() -> [Vec<f32>; 4] {
    /// Pairs of height and width of the Gaussians.
    const TERMS: [(f32, f32); 4] = [(1.0, 0.0047), (1.0, 0.0053), (34.1, 0.04), (13.5, 0.025)];
    let radius = (3.0 * (0.04 / (2.0 * (PI * PI))).sqrt() * PIXELS_PER_DEGREE).ceil() as i32;
    let mut weights = [0, 1, 2, 3].map(|filter| {
        let (height, width) = TERMS[filter];
        let peak = match filter {
            0 | 1 => height * (PI / width).sqrt(),
            // A sum of two Gaussians is not separable; each Gaussian is, by the root of its peak.
            _ => (height * (PI / width).sqrt()).sqrt(),
        };
        let weigh = |at: i32| {
            let x = at as f32 * (1.0 / PIXELS_PER_DEGREE);
            peak * (-(PI * PI) * (x * x) / width).exp()
        };
        (-radius..=radius).map(weigh).collect::<Vec<f32>>()
    });
    let sums = weights
        .each_ref()
        .map(|weights| weights.iter().fold(0.0_f32, |sum, weight| sum + weight));
    let both = 1.0 / (sums[2] * sums[2] + sums[3] * sums[3]).sqrt();
    let norms = [1.0 / sums[0], 1.0 / sums[1], both, both];
    for (weights, norm) in weights.iter_mut().zip(norms) {
        for weight in weights {
            *weight *= norm;
        }
    }
    weights
}

fn compute_feature_weights() -> [Vec<f32>; 3] {
    let sigma = 0.5 * 0.082 * PIXELS_PER_DEGREE;
    let radius = (3.0 * sigma).ceil() as i32;
    let bell = |x: f32| (-(x * x) / (2.0 * sigma * sigma)).exp();
    let formulas: [&dyn Fn(f32) -> f32; 3] = [&bell, &|x| -x * bell(x), &|x| {
        (x * x / (sigma * sigma) - 1.0) * bell(x)
    }];
    formulas.map(|formula| {
        let mut weights: Vec<f32> = (-radius..=radius).map(|x| formula(x as f32)).collect();
        let (mut positive, mut negative) = (0.0, 0.0);
        for weight in &weights {
            if *weight > 0.0 {
                positive += weight
            } else {
                negative -= weight
            }
        }
        // Positive and negative weights add up to 1 each.
        for weight in &mut weights {
            *weight /= if *weight > 0.0 { positive } else { negative };
        }
        weights
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn filters_reach_as_far_as_shading_at_the_instant_is_traced_for_them() {
        let Weights { contrast, feature } = Weights::new();
        let longest = contrast.iter().chain(&feature).map(Vec::len).max();
        assert_eq!(longest, Some(2 * frame::FLIP_REACH as usize + 1));
    }
}
