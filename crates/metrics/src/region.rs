//! Which pixels a score is pooled over; the truth decides, never the picture.

use std::fmt;

use frame::{Raster, Truth};

use crate::nearest::dilate;

/// A set of pixels that the truth defines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Region {
    /// Where anything moved on screen while the shutter was open, and the band that a bleed would reach.
    Moving,
    /// Where nothing did: the picture there is that of the instant. `static` in names and files.
    Still,
    /// The whole picture: reported because readers expect it; a filter that does nothing looks good here.
    Full,
}

/// The truth's regions as masks.
#[derive(Clone, Debug, PartialEq)]
pub struct Regions {
    /// [`Region::Moving`].
    pub moving: Raster<bool>,
    /// [`Region::Still`].
    pub still: Raster<bool>,
}

impl Region {
    /// Every region.
    pub const ALL: [Region; 3] = [Region::Moving, Region::Still, Region::Full];

    /// The word used in metric names and files.
    pub fn name(self) -> &'static str {
        match self {
            Region::Moving => "moving",
            Region::Still => "static",
            Region::Full => "full",
        }
    }
}

impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl Regions {
    /// The values of `map` inside a region, in row order.
    pub fn select<T: Copy>(&self, region: Region, map: &Raster<T>) -> Vec<T> {
        let mask = match region {
            Region::Moving => &self.moving,
            Region::Still => &self.still,
            Region::Full => return map.pixels.clone(),
        };
        assert!(
            mask.same_size(map),
            "a map is pooled over regions of its own size"
        );
        mask.pixels
            .iter()
            .zip(&map.pixels)
            .filter_map(|(inside, value)| inside.then_some(*value))
            .collect()
    }
}

/// Moving: `truth.motion > 0` dilated by a fifteenth of the height (a bleed leaves the support); static: the rest.
pub fn regions(truth: &Truth) -> Regions {
    let radius = f64::from(truth.motion_margin());
    let moving = dilate(&truth.motion.map(|fraction| *fraction > 0.0), radius);
    let still = moving.map(|moves| !moves);
    Regions { moving, still }
}

/// The mean of values; `None` of none.
pub(crate) fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The value that at least 95 % of the values do not exceed (nearest rank); `None` of none.
pub(crate) fn percentile_95(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let rank = (sorted.len() as f64 * 0.95).ceil() as usize;
    sorted.get(rank.checked_sub(1)?).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_percentile_is_the_value_that_95_percent_do_not_exceed() {
        let values: Vec<f64> = (1..=100).rev().map(f64::from).collect();
        assert_eq!(percentile_95(&values), Some(95.0));
        assert_eq!(percentile_95(&values[..10]), Some(100.0));
        assert_eq!(percentile_95(&[3.0]), Some(3.0));
        assert_eq!(percentile_95(&[]), None);
        assert_eq!(mean(&[]), None);
    }
}
