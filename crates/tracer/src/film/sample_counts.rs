//! The number of samples of each pixel.

use frame::Plane;
use rayon::prelude::*;

use crate::film::canvas::Canvas;
use crate::limits::MAX_SAMPLES;

/// Fewest and most samples of a pixel, relative to the mean.
const RANGE: [f64; 2] = [0.125, 8.0];
/// Halvings of the search for the scale at which the mean is reached.
const SEARCH_STEPS: u32 = 60;

/// Samples of each pixel in one replicate, powers of two.
pub(crate) enum SampleCounts {
    /// The same number everywhere.
    Uniform(u32),
    /// A number per pixel of a canvas, in row-major order.
    PerPixel(Vec<u32>),
}

impl SampleCounts {
    /// Shares out samples in proportion to `demand`, per pixel of the canvas, as nearly as powers
    /// of two can, with at most `mean` on the average over the picture. The guard band gets what
    /// its demand would get in the picture.
    ///
    /// No pixel gets less than an eighth of the mean, so that what a pilot missed is not missed
    /// again, and none more than eight times the mean.
    pub fn share(canvas: Canvas, demand: &[f64], mean: u32) -> Self {
        let picture: Vec<u32> = (canvas.pixels().into_iter())
            .filter(|&pixel| canvas.is_in_picture(pixel))
            .collect();
        let largest = (picture.iter())
            .map(|&pixel| demand[pixel as usize])
            .fold(0.0, f64::max);
        if largest <= 0.0 {
            return SampleCounts::Uniform(1 << mean.ilog2());
        }
        let budget = u64::from(mean) * picture.len() as u64;
        let fits = |scale: f64| {
            let counts = picture.par_iter();
            let sum: u64 = counts
                .map(|&pixel| u64::from(nearest_count(scale * demand[pixel as usize], mean)))
                .sum();
            sum <= budget
        };
        // At the lower end all counts are the least, which fit. Scales are compared by their
        // logarithms.
        let mut exponents = [-60.0, 60.0].map(|end| end - f64::log2(largest));
        for _ in 0..SEARCH_STEPS {
            let middle = 0.5 * (exponents[0] + exponents[1]);
            let end = if fits(middle.exp2()) { 0 } else { 1 };
            exponents[end] = middle;
        }
        let scale = exponents[0].exp2();
        let counts = demand.iter();
        SampleCounts::PerPixel(
            counts
                .map(|demand| nearest_count(scale * demand, mean))
                .collect(),
        )
    }

    /// Samples of a pixel.
    pub fn of(&self, pixel: u32) -> u32 {
        match self {
            SampleCounts::Uniform(count) => *count,
            SampleCounts::PerPixel(counts) => counts[pixel as usize],
        }
    }

    /// Samples of several pixels.
    pub fn sum(&self, pixels: &[u32]) -> u64 {
        pixels.iter().map(|&pixel| u64::from(self.of(pixel))).sum()
    }

    /// The numbers as a raster over the canvas.
    pub fn to_plane(&self, canvas: Canvas) -> Plane {
        Plane {
            width: canvas.columns(),
            height: canvas.rows(),
            pixels: (canvas.pixels().into_iter())
                .map(|pixel| self.of(pixel) as f32)
                .collect(),
        }
    }
}

/// The allowed power of two that is nearest to a number, by ratio.
fn nearest_count(number: f64, mean: u32) -> u32 {
    let [least, most] = RANGE.map(|factor| factor * f64::from(mean));
    let least = least.max(1.0).log2().ceil();
    let most = most.min(f64::from(MAX_SAMPLES)).log2().floor();
    1 << number.log2().round().clamp(least, most) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_follow_the_demand_within_the_range_and_the_mean_is_not_exceeded() {
        let demand: Vec<f64> = (0..32).map(|pixel| 1.5_f64.powi(pixel - 16)).collect();
        let canvas = Canvas::bare(8, 4);
        let counts = SampleCounts::share(canvas, &demand, 32);
        let all = canvas.pixels();
        assert!(counts.sum(&all) <= 32 * 32);
        assert!(counts.sum(&all) > 16 * 32, "{}", counts.sum(&all));
        for pair in all.windows(2) {
            assert!(counts.of(pair[0]) <= counts.of(pair[1]));
        }
        assert_eq!([counts.of(0), counts.of(31)], [4, 256]);
    }

    #[test]
    fn any_mean_gives_powers_of_two_within_the_range() {
        let canvas = Canvas::bare(8, 4);
        let demand: Vec<f64> = (0..32).map(|pixel| 1.5_f64.powi(pixel - 16)).collect();
        for mean in [1, 3, 9, 24, 100, 65536] {
            let counts = SampleCounts::share(canvas, &demand, mean);
            for pixel in 0..32 {
                let count = counts.of(pixel);
                assert!(
                    count.is_power_of_two() && count <= MAX_SAMPLES,
                    "{mean}: {count}"
                );
                assert!(8 * count >= mean && count <= 8 * mean, "{mean}: {count}");
            }
            assert!(counts.sum(&canvas.pixels()) <= 32 * u64::from(mean));
        }
        assert_eq!(SampleCounts::share(canvas, &[0.0; 32], 24).of(0), 16);
    }

    #[test]
    fn equal_demand_gets_equal_samples() {
        for demand in [0.0, 1e-30, 1.0, 1e30] {
            let counts = SampleCounts::share(Canvas::bare(8, 4), &[demand; 32], 16);
            assert!((0..32).all(|pixel| counts.of(pixel) == 16));
        }
    }
}
