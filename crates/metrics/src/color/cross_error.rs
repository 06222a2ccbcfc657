//! Squared errors, which the truth's noise does not bias.

use frame::{Image, Raster};

use crate::math::raster::index_pixels;

/// Added to the squared truth in relMSE: a convention that keeps dark pixels from deciding the
/// score.
pub const RELATIVE_EPSILON: f64 = 1e-2;

/// Upper limit of PSNR, in dB: squared differences below 1e-12 are within the rounding of 32-bit
/// radiance.
pub const PSNR_LIMIT: f64 = 120.0;

/// Maps [`squared`].
pub fn squared_error(output: &Image, [a, b]: [&Image; 2], scale: f64) -> Raster<f64> {
    cross([output, output], [a, b], scale)
}

/// Maps `(F - A)(G - B)` with independent F and G, mean over the channels: [`squared`] of a noisy
/// output, given as two halves.
pub fn cross([f, g]: [&Image; 2], [a, b]: [&Image; 2], scale: f64) -> Raster<f64> {
    assert!(
        [g, a, b].iter().all(|image| image.same_size(f)),
        "rasters of different sizes cannot be combined pixel by pixel"
    );
    index_pixels(f, |at| {
        let [f, g, a, b] = [f, g, a, b].map(|image| image.pixels[at]);
        multiply(subtract(f, a), subtract(g, b), scale)
    })
}

/// Computes `(F - A)(F - B)`, mean over the channels, of radiance times `scale`.
///
/// A and B are the truth plus independent noise, so the expectation is the squared error against
/// the converged truth; single pixels may be negative, and so may a mean over pixels if the error
/// of F is as small as the noise. The sign is kept: clamping it would bring the bias back.
pub fn squared(output: [f32; 3], halves: [[f32; 3]; 2], scale: f64) -> f64 {
    let [first, second] = halves.map(|half| subtract(output, half));
    multiply(first, second, scale)
}

/// Computes `(F - A)(F - B) / (T^2 + epsilon)`, mean over the channels. T is the mean of the
/// halves: its noise moves the denominator only.
pub fn relative_squared(
    output: [f32; 3],
    halves: [[f32; 3]; 2],
    mean: [f32; 3],
    scale: f64,
) -> f64 {
    let [f, g] = halves.map(|half| -> [f64; 3] {
        let difference = subtract(output, half);
        std::array::from_fn(|c| {
            let truth = f64::from(mean[c]) * scale;
            difference[c] * scale / (truth * truth + RELATIVE_EPSILON).sqrt()
        })
    });
    (f[0] * g[0] + f[1] * g[1] + f[2] * g[2]) / 3.0
}

/// Estimates the standard deviation of the mean of [`squared`] for a picture without error. `noise`
/// is, per pixel, the squared error of half A against the mean of both halves. `None` if there are
/// no pixels.
///
/// Such a picture scores the mean of products of the halves' independent noises, which scatters
/// about 0. The variance of a product is s^4, where s^2 is the variance of a half (Goodman 1960,
/// "On the Exact Variance of Products"). `noise` is (A - B)^2 / 4, and E (A - B)^4 is 12 s^4 for
/// normal noise, so that s^4 is E (2 noise)^2 / 3. Noise is independent from pixel to pixel, so
/// that variances add.
///
/// The estimate is up to 1.3 times too high if the noises of the channels differ, higher if tails
/// are heavy, and at most a fifth too low if there are none.
pub fn scatter(noise: impl Iterator<Item = f64>) -> Option<f64> {
    let (mut fourths, mut count) = (0.0, 0_u32);
    for square in noise {
        fourths += (2.0 * square).powi(2);
        count += 1;
    }
    (count > 0).then(|| (fourths / 3.0).sqrt() / f64::from(count))
}

/// Converts a mean squared error to the peak signal to noise ratio in dB, with peak 1. An error
/// below `floor`, which the truth cannot distinguish from none, counts as `floor`; see
/// [`PSNR_LIMIT`] for no error at all.
pub fn psnr(squared_error: f64, floor: f64) -> f64 {
    let limit = 10f64.powf(-PSNR_LIMIT / 10.0);
    -10.0 * squared_error.max(floor).max(limit).log10()
}

/// Computes the mean over the channels of a product, of radiance times `scale`.
pub fn multiply(f: [f64; 3], g: [f64; 3], scale: f64) -> f64 {
    (f[0] * g[0] + f[1] * g[1] + f[2] * g[2]) * scale * scale / 3.0
}

fn subtract(a: [f32; 3], b: [f32; 3]) -> [f64; 3] {
    std::array::from_fn(|c| f64::from(a[c]) - f64::from(b[c]))
}
