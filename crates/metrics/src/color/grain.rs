//! Grain: noise and patterns of pixel size in a picture's error, relative to the truth's
//! brightness.
//!
//! Second differences along rows and columns find what changes from pixel to pixel. Misplaced and
//! missing edges do, too, but most lie along one line, or look the same on a coarser grid. So
//! second differences over two pixels, of smoothed errors, are subtracted: they hold edges, and
//! hardly any noise.

use frame::{Image, Raster};

use crate::math::convolution::filter_separably;
use crate::math::raster::{index_pixels, map_pixels};

/// Added to the truth's brightness, in display-scaled radiance: keeps black from deciding the
/// score.
pub const BRIGHTNESS_EPSILON: f64 = 1e-2;

/// Coarse error that halves the weight of a pixel: grain is found where the rest of the error is
/// smooth.
const COARSE_EPSILON: f64 = 0.02;

/// Sum of the squared correlations of second differences between pixels: along one axis 1, -2/3 and
/// 1/6.
const CORRELATION: f64 =
    (1.0 + 2.0 * (4.0 / 9.0 + 1.0 / 36.0)) * (1.0 + 2.0 * (4.0 / 9.0 + 1.0 / 36.0));

/// Part of white noise's power in the fine error that is in the coarse one, too: the squares of
/// both kernels' sums of squares.
const WHITE_IN_COARSE: f64 = (1.75 / 6.0) * (1.75 / 6.0);

/// Side of the square that brightness and coarse errors are averaged over.
const WINDOW: usize = 5;

/// Second differences of one axis, which keep the power of white noise.
fn fine() -> [f64; 3] {
    [1.0, -2.0, 1.0].map(|tap: f64| tap / 6f64.sqrt())
}

/// Second differences over two pixels of pairs of means of neighbours, at the same scale.
fn coarse() -> [f64; 7] {
    [0.25, 0.5, -0.25, -1.0, -0.25, 0.5, 0.25].map(|tap: f64| tap / 6f64.sqrt())
}

/// Grain of a pixel.
#[derive(Clone, Copy, Debug)]
pub struct PixelGrain {
    /// Weight in means: low where coarse errors are large.
    pub weight: f64,
    /// Unbiased squared grain, relative to brightness; negative by noise, or for blurred edges.
    pub squared: f64,
    /// Squared noise of the truth's mean in it.
    pub noise: f64,
}

/// A truth that the grain of pictures is measured against.
pub struct GrainTruth {
    /// Factor from radiance to a part of the brightness around each pixel.
    gain: Raster<f64>,
    /// Squared noise of the truth's mean among fine differences.
    noise: Raster<f64>,
}

impl GrainTruth {
    /// Prepares the mean of two halves; `scale` is the factor from radiance to display.
    pub fn new(mean: &Image, [a, b]: [&Image; 2], scale: f64) -> Self {
        let squares = average(&map_pixels(mean, |color| brightness(*color, scale).powi(2)));
        let gain = map_pixels(&squares, |square| {
            scale / (square.sqrt() + BRIGHTNESS_EPSILON)
        });
        let noise = |at: usize, c: usize| f64::from(a.pixels[at][c] - b.pixels[at][c]) / 2.0;
        let [noise, _] = multiply_differences(&gain, [&noise, &noise]);
        Self { gain, noise }
    }

    /// Maps the grain of a picture against two halves of the truth: products of differences,
    /// unbiased like the squared error `(F - A)(F - B)`.
    pub fn map(&self, output: &Image, [a, b]: [&Image; 2]) -> Raster<PixelGrain> {
        let error = |half: &Image, at: usize, c: usize| {
            f64::from(output.pixels[at][c]) - f64::from(half.pixels[at][c])
        };
        let [first, second] = [a, b].map(|half| move |at, c| error(half, at, c));
        let [fine, coarse] = multiply_differences(&self.gain, [&first, &second]);
        let around = average(&coarse);
        index_pixels(&fine, |at| PixelGrain {
            weight: 1.0 / (around.pixels[at].max(0.0) + COARSE_EPSILON * COARSE_EPSILON),
            squared: (fine.pixels[at] - coarse.pixels[at]) / (1.0 - WHITE_IN_COARSE),
            noise: self.noise.pixels[at] / (1.0 - WHITE_IN_COARSE),
        })
    }
}

/// Computes the brightness of a colour at the viewing exposure: the root mean square over the
/// channels.
pub fn brightness(color: [f32; 3], scale: f64) -> f64 {
    let squares: f64 = color.iter().map(|value| f64::from(*value).powi(2)).sum();
    scale * (squares / 3.0).sqrt()
}

/// An error of a pixel's channel.
type ChannelError<'a> = &'a (dyn Fn(usize, usize) -> f64 + Send + Sync);

/// Maps the products of the fine differences of two errors times `gain`, and of the coarse ones;
/// means over the channels.
fn multiply_differences(gain: &Raster<f64>, errors: [ChannelError; 2]) -> [Raster<f64>; 2] {
    let scaled = errors
        .map(|error| [0, 1, 2].map(|c| index_pixels(gain, |at| error(at, c) * gain.pixels[at])));
    let (fine, coarse) = (fine(), coarse());
    [&fine[..], &coarse[..]].map(|taps| {
        let [f, g] = (scaled.each_ref()).map(|channels| {
            (channels.each_ref()).map(|channel| filter_separably(channel, taps, taps))
        });
        index_pixels(gain, |at| {
            let products = f.iter().zip(&g).map(|(f, g)| f.pixels[at] * g.pixels[at]);
            products.sum::<f64>() / 3.0
        })
    })
}

/// Averages over a square around each pixel.
fn average(map: &Raster<f64>) -> Raster<f64> {
    let taps = [1.0 / WINDOW as f64; WINDOW];
    filter_separably(map, &taps, &taps)
}

/// Averages the squared grain; `None` if there are no pixels.
pub fn pool_grain<'a>(pixels: impl Iterator<Item = &'a PixelGrain>) -> Option<f64> {
    let (mut sum, mut weights) = (0.0, 0.0);
    for pixel in pixels {
        sum += pixel.weight * pixel.squared;
        weights += pixel.weight;
    }
    (weights > 0.0).then(|| sum / weights)
}

/// Estimates the standard deviation of [`pool_grain`] for a picture without error; `None` if there
/// are no pixels. As [`scatter`](super::cross_error::scatter) says, the variance of a pixel's
/// product is the mean of (2 noise)² / 3; neighbours correlate.
pub fn scatter_grain<'a>(pixels: impl Iterator<Item = &'a PixelGrain>) -> Option<f64> {
    let (mut fourths, mut weights) = (0.0, 0.0);
    for pixel in pixels {
        fourths += (pixel.weight * 2.0 * pixel.noise).powi(2);
        weights += pixel.weight;
    }
    (weights > 0.0).then(|| (CORRELATION * fourths / 3.0).sqrt() / weights)
}

/// Converts mean squared grain to grain. What noise or blurred edges take below 0 keeps its sign.
pub fn grain(squared: f64) -> f64 {
    squared.abs().sqrt().copysign(squared)
}
