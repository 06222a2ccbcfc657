//! Gradient magnitude of a matte, and its error.

use frame::{Plane, Raster};

use crate::color::convolution::{gaussian, separable};

/// Magnitude of a matte's gradient by derivatives of a Gaussian of 1.4 pixels, per pixel.
pub fn gradient_magnitude(matte: &Plane) -> Raster<f64> {
    let (bell, slope) = (gaussian(1.4, 4.0, false), gaussian(1.4, 4.0, true));
    let matte = matte.map(|value| f64::from(*value));
    let across = separable(&matte, &slope, &bell);
    across.zip(&separable(&matte, &bell, &slope), |x, y| x.hypot(*y))
}

/// Squared difference of two gradient magnitudes per pixel: Rhemann et al., "A Perceptually Motivated Online Benchmark for
/// Image Matting" (CVPR 2009), where it follows what observers say better than squared differences do.
pub fn gradient_error(a: &Raster<f64>, b: &Raster<f64>) -> Raster<f64> {
    a.zip(b, |a, b| (a - b).powi(2))
}
