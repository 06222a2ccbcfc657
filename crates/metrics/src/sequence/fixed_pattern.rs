//! Screen-fixed pattern: fine error that stays in place on the screen while the picture moves, like
//! dirt on a window.

use frame::{Image, Raster};

use super::pairs::{mean_in, subtract};
use crate::color::cross_error::multiply;
use crate::math::pooling::mean;
use crate::math::raster::{around, index_pixels};

/// Radius in pixels of the square whose mean is subtracted, which leaves only fine patterns.
const RADIUS: usize = 2;

/// Fine parts of one frame's error.
pub struct FineError {
    /// Against each half of the truth.
    halves: [Image; 2],
    /// Pixels where anything moves.
    moving: Raster<bool>,
}

impl FineError {
    /// Extracts the fine part of a picture's errors against the truth's halves.
    pub fn new(picture: &Image, halves: [&Image; 2], moving: &Raster<bool>) -> Self {
        Self {
            halves: halves.map(|half| fine(&subtract(picture, half))),
            moving: moving.clone(),
        }
    }
}

/// Averages the product of two frames' fine errors at one place of the screen, over all pairs of
/// frames, where both have motion. The two frames are compared with different halves of the truth,
/// so that its noise does not bias it. None if no pair has a pixel in common.
pub fn correlate(frames: &[FineError], scale: f64) -> Option<f64> {
    let mut products = Vec::new();
    for (index, now) in frames.iter().enumerate() {
        for before in &frames[..index] {
            let mask = now
                .moving
                .zip(&before.moving, |now, before| *now && *before);
            let map = index_pixels(&mask, |at| {
                let product = |a: usize, b: usize| {
                    let [x, y] = [before.halves[a].pixels[at], now.halves[b].pixels[at]];
                    multiply(x.map(f64::from), y.map(f64::from), scale)
                };
                0.5 * (product(0, 1) + product(1, 0))
            });
            products.extend(mean_in(&map, &mask));
        }
    }
    mean(products)
}

/// Subtracts the mean of the square around each pixel, as far as that is in the picture.
pub fn fine(image: &Image) -> Image {
    index_pixels(image, |at| {
        let (mut sum, mut count) = ([0.0_f64; 3], 0.0);
        for near in around(image, at, RADIUS) {
            sum = std::array::from_fn(|c| sum[c] + f64::from(image.pixels[near][c]));
            count += 1.0;
        }
        std::array::from_fn(|c| (f64::from(image.pixels[at][c]) - sum[c] / count) as f32)
    })
}
