//! Errors of one picture over one region.

use frame::{Raster, Region, Regions};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::color::cross_error::scatter;
use crate::color::grain::{pool_grain, scatter_grain};
use crate::math::pooling::{mean, percentile, percentile_of, weighted_median};
use crate::picture::error_maps::ErrorMaps;

/// Error maps pooled over one region.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pooled {
    /// Mean of `squared`.
    pub mse: f64,
    /// Mean of `relative`.
    pub relmse: f64,
    /// Mean of `absolute`.
    pub mae: f64,
    /// Mean of `symmetric`.
    pub smape: f64,
    /// Mean of LDR-FLIP.
    pub flip: f64,
    /// Value of LDR-FLIP up to which pixels make up half of its sum.
    pub flip_weighted_median: f64,
    /// 95th percentile of LDR-FLIP.
    pub flip_p95: f64,
    /// 99th percentile of LDR-FLIP.
    pub flip_p99: f64,
    /// Mean of HDR-FLIP.
    pub flip_hdr: f64,
    /// Mean of SSIM over the pixels with their window in the picture; `None` if the region has no
    /// such pixel.
    pub ssim: Option<f64>,
    /// Mean squared grain.
    pub grain: f64,
    /// Mean of the label total variation.
    pub label: f64,
    /// 95th percentile of the label total variation.
    pub label_p95: f64,
}

impl Pooled {
    /// Pools maps over every region; `None` for those that are empty. `windows` marks the pixels
    /// with their SSIM window in the picture.
    pub fn over_all(
        errors: &ErrorMaps,
        regions: &Regions,
        windows: &Raster<bool>,
    ) -> [Option<Self>; Region::ALL.len()] {
        let mut all = [None; Region::ALL.len()];
        let pairs = all.par_iter_mut().zip(Region::ALL);
        pairs.for_each(|(pooled, region)| *pooled = Self::new(errors, regions, region, windows));
        all
    }

    /// Pools maps over a region; `None` if it is empty.
    pub fn new(
        errors: &ErrorMaps,
        regions: &Regions,
        region: Region,
        windows: &Raster<bool>,
    ) -> Option<Self> {
        let mut sums = [0.0; 6];
        let mut ssim = Vec::new();
        let (mut flip, mut label) = (Vec::new(), Vec::new());
        for at in regions.indices(region) {
            let own = &errors.pixels.pixels[at];
            let found = errors.flip.pixels[at];
            let values = [
                own.squared,
                own.relative,
                own.absolute,
                own.symmetric,
                f64::from(found),
                f64::from(errors.flip_hdr.pixels[at]),
            ];
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum += value;
            }
            if windows.pixels[at] {
                ssim.push(errors.ssim.pixels[at]);
            }
            flip.push(found);
            label.push(errors.label.pixels[at]);
        }
        let label_mean = mean(label.iter().copied())?;
        // None is negative, and so their bits are in their order.
        flip.sort_unstable_by_key(|error| error.to_bits());
        let [mse, relmse, mae, smape, flip_mean, flip_hdr] =
            sums.map(|sum| sum / flip.len() as f64);
        Some(Self {
            mse,
            relmse,
            mae,
            smape,
            flip: flip_mean,
            flip_weighted_median: weighted_median(&flip)?,
            flip_p95: percentile(&flip, 0.95)?,
            flip_p99: percentile(&flip, 0.99)?,
            flip_hdr,
            ssim: mean(ssim),
            grain: pool_grain(regions.indices(region).map(|at| &errors.grain.pixels[at]))?,
            label: label_mean,
            label_p95: percentile_of(label, 0.95)?,
        })
    }

    /// Pools noise floors over every region, from the errors of the truth's first half against the
    /// mean. Unbiased errors of a perfect picture scatter about 0 and are smaller than the noise,
    /// see [`scatter`].
    pub fn of_noise(
        noise: &ErrorMaps,
        regions: &Regions,
        windows: &Raster<bool>,
    ) -> [Option<Self>; Region::ALL.len()] {
        let mut all = Self::over_all(noise, regions, windows);
        for (pooled, region) in all.iter_mut().zip(Region::ALL) {
            let errors = || regions.indices(region).map(|at| &noise.pixels.pixels[at]);
            if let Some(pooled) = pooled {
                let scattered = "a region that is pooled over has pixels";
                pooled.mse = scatter(errors().map(|own| own.squared)).expect(scattered);
                pooled.relmse = scatter(errors().map(|own| own.relative)).expect(scattered);
                let grain = regions.indices(region).map(|at| &noise.grain.pixels[at]);
                pooled.grain = scatter_grain(grain).expect(scattered);
            }
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::grain::PixelGrain;
    use crate::picture::error_maps::PixelErrors;

    /// Makes maps of 100 pixels, on which each error grows from pixel to pixel at a pace of its
    /// own.
    fn maps() -> (ErrorMaps, Regions, Raster<bool>) {
        let raster = |factor: f32| Raster::from_fn(10, 10, |x, y| factor * (10 * y + x + 1) as f32);
        let errors = ErrorMaps {
            pixels: raster(1.0).map(|value| PixelErrors {
                squared: f64::from(*value),
                relative: 10.0 * f64::from(*value),
                absolute: 3.0 * f64::from(*value),
                symmetric: 4.0 * f64::from(*value),
            }),
            ssim: raster(5.0).map(|value| f64::from(*value)),
            flip: raster(6.0),
            flip_hdr: raster(7.0),
            label: raster(8.0).map(|value| f64::from(*value)),
            grain: raster(9.0).map(|value| PixelGrain {
                weight: 1.0,
                squared: f64::from(*value),
                noise: 0.0,
            }),
        };
        let all = Raster::filled(10, 10, true);
        let regions = Regions {
            moving: all.clone(),
            support: all.clone(),
            still: all.clone(),
            knowable: all.clone(),
            unknowable: all.clone(),
        };
        (errors, regions, all)
    }

    #[test]
    fn each_error_has_its_own_mean_and_percentiles() {
        let (errors, regions, windows) = maps();
        let found = Pooled::new(&errors, &regions, Region::Moving, &windows).unwrap();
        let means = [found.mse, found.relmse, found.mae, found.smape, found.flip];
        // The mean of 1 to 100 is 50.5.
        assert_eq!(
            means,
            [1.0, 10.0, 3.0, 4.0, 6.0].map(|factor| factor * 50.5)
        );
        assert_eq!([found.flip_hdr, found.label], [7.0 * 50.5, 8.0 * 50.5]);
        assert_eq!(found.ssim, Some(5.0 * 50.5));
        assert_eq!([found.flip_p95, found.flip_p99], [6.0 * 95.0, 6.0 * 99.0]);
        assert_eq!(found.label_p95, 8.0 * 95.0);
        // 1 to 71 add up to 2556, and half of all is 2525.
        assert_eq!(found.flip_weighted_median, 6.0 * 71.0);
    }

    #[test]
    fn the_noise_of_each_unbiased_error_is_its_own_scatter() {
        let (errors, regions, windows) = maps();
        for pooled in Pooled::of_noise(&errors, &regions, &windows)
            .into_iter()
            .flatten()
        {
            let due = scatter((1..=100).map(f64::from)).unwrap();
            assert!((pooled.mse / due - 1.0).abs() < 1e-12, "{pooled:?}");
            assert!(
                (pooled.relmse / (10.0 * due) - 1.0).abs() < 1e-12,
                "{pooled:?}"
            );
            assert_eq!(pooled.mae, 3.0 * 50.5);
        }
    }
}
