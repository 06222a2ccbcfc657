//! Structural similarity.

use frame::{Image, Raster, display_srgb};

use crate::Viewing;
use crate::math::convolution::{filter_separably, gaussian};

/// Width of the border that is not pooled, in pixels: the window's radius, 3.5 standard deviations of 1.5 pixels.
pub const SSIM_BORDER: u32 = 5;

const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// Maps SSIM, mean over the channels of what a display shows, in [-1, 1]; 1 is equal. Wang et al., "Image Quality
/// Assessment: From Error Visibility to Structural Similarity" (2004), with a Gaussian window, biased covariance and data
/// range 1, as scikit-image computes it with `gaussian_weights`.
pub fn ssim(output: &Image, truth: &Image, viewing: &Viewing) -> Raster<f64> {
    let [output, truth] = [output, truth].map(|image| display_srgb(image, viewing.stops));
    let channels = [0, 1, 2].map(|c| {
        let channel = |image: &Image| image.map(|pixel| f64::from(pixel[c]));
        ssim_of(&channel(&output), &channel(&truth))
    });
    let [red, green, blue] = channels;
    red.zip(&green, |r, g| r + g)
        .zip(&blue, |sum, b| (sum + b) / 3.0)
}

/// Maps SSIM of two planes with values in [0, 1].
pub fn ssim_of(a: &Raster<f64>, b: &Raster<f64>) -> Raster<f64> {
    let window = gaussian(1.5, 3.5, false);
    let local = |map: &Raster<f64>| filter_separably(map, &window, &window);
    let (mean_a, mean_b) = (local(a), local(b));
    let squares_a = local(&a.map(|x| x * x));
    let squares_b = local(&b.map(|x| x * x));
    let products = local(&a.zip(b, |x, y| x * y));
    Raster::from_fn(a.width, a.height, |x, y| {
        let (ma, mb) = (mean_a.at(x, y), mean_b.at(x, y));
        let variances = squares_a.at(x, y) - ma * ma + squares_b.at(x, y) - mb * mb;
        let covariance = products.at(x, y) - ma * mb;
        (2.0 * ma * mb + C1) * (2.0 * covariance + C2)
            / ((ma * ma + mb * mb + C1) * (variances + C2))
    })
}
