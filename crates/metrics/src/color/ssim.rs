//! Structural similarity.

use frame::{Image, Raster};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use crate::math::convolution::{LANES, gaussian, mirror_index, mirrored_places};
use crate::math::lines::{correlate, correlate_down};

/// Width of the border that is not pooled, in pixels: the window's radius, 3.5 standard deviations
/// of 1.5 pixels.
pub const SSIM_BORDER: u32 = 5;

const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// Rows that are filtered one after another.
const BAND: usize = 64;

/// Planes that are filtered: both pictures, their squares and their product.
const FILTERED: usize = 5;

/// Maps SSIM of display values, mean over the channels, in [-1, 1]; 1 is equal. Wang et al., "Image
/// Quality Assessment: From Error Visibility to Structural Similarity" (2004), with a Gaussian
/// window, biased covariance and data range 1, as scikit-image computes it with `gaussian_weights`.
pub fn map_ssim(output: &Image, truth: &Image) -> Raster<f64> {
    map_mean(output, truth, |pixel, c| f64::from(pixel[c]))
}

/// Maps the mean over three channels of the SSIM of two pictures with values in [0, 1].
fn map_mean<T: Sync>(a: &Raster<T>, b: &Raster<T>, channel: fn(&T, usize) -> f64) -> Raster<f64> {
    let width = a.width as usize;
    let window = gaussian(1.5, 3.5, false);
    let places = mirrored_places(width, window.len() / 2);
    let mut map = Raster::filled(a.width, a.height, 0.0);
    let bands = map.pixels.par_chunks_mut(BAND * width).enumerate();
    bands.for_each(|(band, map)| {
        Arch::new().dispatch(Band {
            pictures: [a, b],
            channel,
            window: &window,
            places: &places,
            first: band * BAND,
            map,
        });
    });
    map
}

/// Maps SSIM of two planes with values in [0, 1].
#[cfg(test)]
pub fn ssim_of(a: &Raster<f64>, b: &Raster<f64>) -> Raster<f64> {
    map_mean(a, b, |value, _| *value)
}

/// A band of rows.
struct Band<'a, T> {
    pictures: [&'a Raster<T>; 2],
    channel: fn(&T, usize) -> f64,
    window: &'a [f64],
    /// Column of each place of a row that is mirrored at its ends.
    places: &'a [usize],
    first: usize,
    map: &'a mut [f64],
}

impl<T> WithSimd for Band<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            pictures,
            channel,
            window,
            places,
            first,
            map,
        } = self;
        let (width, height) = (pictures[0].width as usize, pictures[0].height as usize);
        let radius = window.len() / 2;
        let stride = width.next_multiple_of(LANES);
        let mut padded = [(); FILTERED].map(|()| vec![0.0; stride + 2 * radius]);
        let mut recent = vec![0.0; window.len() * FILTERED * stride];
        for c in 0..3 {
            let mut next = first.saturating_sub(radius);
            for (y, map) in (first..).zip(map.chunks_exact_mut(width)) {
                while next < height.min(y + radius + 1) {
                    let [a, b] = pictures.map(|picture| &picture.pixels[next * width..][..width]);
                    for (at, place) in places.iter().enumerate() {
                        let [x, y] = [channel(&a[*place], c), channel(&b[*place], c)];
                        padded[0][at] = x;
                        padded[1][at] = y;
                    }
                    multiply(&mut padded);
                    let start = next % window.len() * FILTERED * stride;
                    let lines = recent[start..].chunks_exact_mut(stride);
                    for (values, line) in padded.iter().zip(lines) {
                        correlate::<S, f64, LANES>(simd, window, values, line);
                    }
                    next += 1;
                }
                let starts: Vec<usize> = (0..window.len())
                    .map(|tap| mirror_index(y + tap, radius, height))
                    .map(|row| row % window.len() * FILTERED * stride)
                    .collect();
                for (block, map) in map.chunks_mut(LANES).enumerate() {
                    let mut local = [[0.0; LANES]; FILTERED];
                    for (plane, sums) in local.iter_mut().enumerate() {
                        let from = plane * stride + block * LANES;
                        *sums = correlate_down(simd, window, &recent[from..], &starts);
                    }
                    let [a, b, aa, bb, ab] = &local;
                    let mut similar = [0.0; LANES];
                    for lane in 0..LANES {
                        similar[lane] = compare([a[lane], b[lane], aa[lane], bb[lane], ab[lane]]);
                    }
                    for (map, similar) in map.iter_mut().zip(similar) {
                        // The last of three channels makes the sum a mean.
                        *map = match c {
                            2 => (*map + similar) / 3.0,
                            _ => *map + similar,
                        };
                    }
                }
            }
        }
    }
}

/// Fills in the squares of the first two lines, and their product.
#[inline(always)]
fn multiply([x, y, xx, yy, xy]: &mut [Vec<f64>; FILTERED]) {
    for (square, x) in xx.iter_mut().zip(x.iter()) {
        *square = x * x;
    }
    for (square, y) in yy.iter_mut().zip(y.iter()) {
        *square = y * y;
    }
    for (product, (x, y)) in xy.iter_mut().zip(x.iter().zip(y.iter())) {
        *product = x * y;
    }
}

/// Computes SSIM of local means: of both pictures, their squares and their product.
#[inline(always)]
fn compare([ma, mb, squares_a, squares_b, products]: [f64; FILTERED]) -> f64 {
    let variances = squares_a - ma * ma + squares_b - mb * mb;
    let covariance = products - ma * mb;
    (2.0 * ma * mb + C1) * (2.0 * covariance + C2) / ((ma * ma + mb * mb + C1) * (variances + C2))
}
