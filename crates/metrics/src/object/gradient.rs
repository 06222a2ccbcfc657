//! Gradient magnitude of a matte, and its error.

use frame::{Plane, Raster};

use crate::math::convolution::{filter_separably, gaussian};

/// Maps the magnitude of a matte's gradient, by derivatives of a Gaussian of 1.4 pixels.
pub fn gradient_magnitude(matte: &Plane) -> Raster<f64> {
    let (bell, slope) = (gaussian(1.4, 4.0, false), gaussian(1.4, 4.0, true));
    let matte = matte.map(|value| f64::from(*value));
    let across = filter_separably(&matte, &slope, &bell);
    across.zip(&filter_separably(&matte, &bell, &slope), |x, y| x.hypot(*y))
}

/// Maps the squared difference of two gradient magnitudes: Rhemann et al., "A Perceptually Motivated Online Benchmark for Image
/// Matting" (CVPR 2009), where it agrees with observers better than squared differences do.
pub fn gradient_error(a: &Raster<f64>, b: &Raster<f64>) -> Raster<f64> {
    a.zip(b, |a, b| (a - b).powi(2))
}
