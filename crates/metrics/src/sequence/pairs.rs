//! Differences between consecutive frames, and their errors.

use frame::{Image, Raster};

use super::along::Before;
use super::instant::Instant;
use crate::color::cross_error::{scatter, squared_error};
use crate::math::pooling::mean;
use crate::math::raster::{index_pixels, zip_pixels};

/// Differences of one frame of the truth from the frame before.
pub struct Pair {
    /// Pixels that are pooled over.
    pub mask: Raster<bool>,
    /// Differences of the truth's halves.
    halves: [Image; 2],
    /// Where every point was before, for differences along the motion.
    before: Option<Before>,
}

impl Pair {
    /// Takes differences at fixed places of the screen.
    pub fn at_fixed_places([before, now]: [&[Image; 2]; 2], mask: Raster<bool>) -> Self {
        Self {
            halves: [0, 1].map(|half| subtract(&now[half], &before[half])),
            before: None,
            mask,
        }
    }

    /// Takes differences along the motion, where the point was seen in both frames.
    pub fn along_the_motion(
        instants: [&Instant; 2],
        [before, now]: [&[Image; 2]; 2],
        mask: &Raster<bool>,
    ) -> Self {
        let way = Before::new(instants[0], instants[1]);
        Self {
            mask: index_pixels(mask, |at| mask.pixels[at] && way.is_seen(at)),
            halves: [0, 1].map(|half| subtract(&now[half], &way.take(&before[half]))),
            before: Some(way),
        }
    }

    /// Maps the squared error of the difference between two pictures, without the bias of the
    /// truth's noise.
    pub fn map_error(&self, [before, now]: [&Image; 2], scale: f64) -> Raster<f64> {
        let difference = match &self.before {
            None => subtract(now, before),
            Some(way) => subtract(now, &way.take(before)),
        };
        squared_error(&difference, self.halves.each_ref(), scale)
    }

    /// Pools a map of errors; none if no pixel is pooled over.
    pub fn pool(&self, map: &Raster<f64>) -> Option<f64> {
        mean_in(map, &self.mask)
    }

    /// Estimates the error that the truth's noise makes.
    pub fn floor(&self, scale: f64) -> Option<f64> {
        scatter_in(self.halves.each_ref(), &self.mask, scale)
    }
}

/// Averages a map inside a mask; none if the mask is empty.
pub fn mean_in(map: &Raster<f64>, mask: &Raster<bool>) -> Option<f64> {
    let values = map.pixels.iter().zip(&mask.pixels);
    mean(values.filter(|(_, holds)| **holds).map(|(value, _)| *value))
}

/// Estimates the scatter of the mean of products of two halves' noises inside a mask.
pub fn scatter_in([a, b]: [&Image; 2], mask: &Raster<bool>, scale: f64) -> Option<f64> {
    let half_of_difference = zip_pixels(a, b, |a, b| -> f64 {
        let square = |c: usize| (f64::from(a[c]) - f64::from(b[c])).powi(2);
        (square(0) + square(1) + square(2)) / 12.0 * scale * scale
    });
    let noise = half_of_difference.pixels.iter().zip(&mask.pixels);
    scatter(noise.filter(|(_, holds)| **holds).map(|(noise, _)| *noise))
}

pub fn subtract(a: &Image, b: &Image) -> Image {
    zip_pixels(a, b, |a, b| std::array::from_fn(|c| a[c] - b[c]))
}
