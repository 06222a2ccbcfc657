//! Errors of one picture over one region.

use frame::{Raster, Region, Regions};

use crate::color::cross_error::scatter;
use crate::math::pooling::{mean, percentile, sort, weighted_median};
use crate::picture::error_maps::ErrorMaps;

/// Error maps pooled over one region.
#[derive(Clone, Copy, Debug)]
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
    /// Value of LDR-FLIP at or below which half of its sum lies.
    pub flip_weighted_median: f64,
    /// 95th percentile of LDR-FLIP.
    pub flip_p95: f64,
    /// 99th percentile of LDR-FLIP.
    pub flip_p99: f64,
    /// Mean of HDR-FLIP.
    pub flip_hdr: f64,
    /// Mean of SSIM over the pixels whose window lies in the picture; `None` if the region has no such pixel.
    pub ssim: Option<f64>,
    /// Mean of the label total variation.
    pub label: f64,
    /// 95th percentile of the label total variation.
    pub label_p95: f64,
}

impl Pooled {
    /// Pools maps over a region; `None` if it is empty. `windows` marks the pixels whose SSIM window lies in the picture.
    pub fn new(
        errors: &ErrorMaps,
        regions: &Regions,
        region: Region,
        windows: &Raster<bool>,
    ) -> Option<Self> {
        let inside = |map| regions.select(region, map);
        let flip = sort(inside(&errors.flip));
        let label = inside(&errors.label);
        let windows = regions.select(region, windows);
        let ssim = inside(&errors.ssim).into_iter().zip(windows);
        let ssim: Vec<f64> = ssim
            .filter_map(|(value, whole)| whole.then_some(value))
            .collect();
        Some(Self {
            mse: mean(&inside(&errors.squared))?,
            relmse: mean(&inside(&errors.relative))?,
            mae: mean(&inside(&errors.absolute))?,
            smape: mean(&inside(&errors.symmetric))?,
            flip: mean(&inside(&errors.flip))?,
            flip_weighted_median: weighted_median(&flip)?,
            flip_p95: percentile(&flip, 0.95)?,
            flip_p99: percentile(&flip, 0.99)?,
            flip_hdr: mean(&inside(&errors.flip_hdr))?,
            ssim: mean(&ssim),
            label: mean(&label)?,
            label_p95: percentile(&sort(label), 0.95)?,
        })
    }

    /// Pools noise floors, from the errors of the truth's first half against the mean. Unbiased errors of a perfect picture scatter
    /// about 0 and are smaller than the noise, see [`scatter`].
    pub fn of_noise(
        noise: &ErrorMaps,
        regions: &Regions,
        region: Region,
        windows: &Raster<bool>,
    ) -> Option<Self> {
        Some(Self {
            mse: scatter(&regions.select(region, &noise.squared))?,
            relmse: scatter(&regions.select(region, &noise.relative))?,
            ..Self::new(noise, regions, region, windows)?
        })
    }
}
