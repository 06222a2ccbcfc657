//! Which pixels a score is pooled over; the truth decides, never the picture.

use std::fmt;

use crate::{Image, Raster, Truth};

/// A set of pixels that the truth defines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Region {
    /// Where anything moved on screen while the shutter was open, and the band that a bleed would reach.
    Moving,
    /// Where anything moved on screen while the shutter was open, without that band: a thin smear is not diluted.
    Support,
    /// Where nothing did: the picture there is that of the instant. `static` in names and files.
    Still,
    /// The whole picture: reported because readers expect it; a filter that does nothing looks good here.
    Full,
    /// Of the moving pixels, those where everything that the shutter sees can be seen in the frame of the instant.
    Knowable,
    /// The other moving pixels: part of what the shutter sees is hidden from the frame, or lies beyond its border, so that
    /// every filter has to guess.
    Unknowable,
}

/// The truth's regions as masks.
#[derive(Clone, Debug, PartialEq)]
pub struct Regions {
    /// [`Region::Moving`].
    pub moving: Raster<bool>,
    /// [`Region::Support`].
    pub support: Raster<bool>,
    /// [`Region::Still`].
    pub still: Raster<bool>,
    /// [`Region::Knowable`].
    pub knowable: Raster<bool>,
    /// [`Region::Unknowable`].
    pub unknowable: Raster<bool>,
}

impl Region {
    /// Every region.
    pub const ALL: [Region; 6] = [
        Region::Moving,
        Region::Support,
        Region::Still,
        Region::Full,
        Region::Knowable,
        Region::Unknowable,
    ];

    /// The word used in metric names and files.
    pub fn name(self) -> &'static str {
        match self {
            Region::Moving => "moving",
            Region::Support => "support",
            Region::Still => "static",
            Region::Full => "full",
            Region::Knowable => "knowable",
            Region::Unknowable => "unknowable",
        }
    }
}

impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl Regions {
    /// The pixels of a region; none where these are all.
    pub fn mask(&self, region: Region) -> Option<&Raster<bool>> {
        match region {
            Region::Moving => Some(&self.moving),
            Region::Support => Some(&self.support),
            Region::Still => Some(&self.still),
            Region::Full => None,
            Region::Knowable => Some(&self.knowable),
            Region::Unknowable => Some(&self.unknowable),
        }
    }

    /// The values of `map` inside a region, in row order.
    pub fn select<T: Copy>(&self, region: Region, map: &Raster<T>) -> Vec<T> {
        let Some(mask) = self.mask(region) else {
            return map.pixels.clone();
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

/// Derives the regions from the truth's [`Support`](crate::Support), which its noise does not change.
///
/// Support: where anything moves. Moving: that dilated by a disc of a fifteenth of the height (a bleed leaves the support).
/// Static: the rest. Moving pixels are knowable where the support saw nothing that the frame does not show.
pub fn regions(truth: &Truth) -> Regions {
    let support = &truth.support.moving;
    let hidden = &truth.support.unknowable;
    let moving = dilated(support, truth.motion_margin());
    Regions {
        still: moving.map(|moves| !moves),
        knowable: moving.zip(hidden, |moves, hidden| *moves && !hidden),
        unknowable: moving.zip(hidden, |moves, hidden| *moves && *hidden),
        support: support.clone(),
        moving,
    }
}

/// Every pixel whose centre lies within `radius` pixels of that of a pixel of `set`.
fn dilated(set: &Raster<bool>, radius: u32) -> Raster<bool> {
    let mut disc = Raster::filled(set.width, set.height, false);
    for y in 0..set.height {
        for row in y.saturating_sub(radius)..=(y + radius).min(set.height - 1) {
            let reach = (radius * radius - y.abs_diff(row).pow(2)).isqrt();
            widen(row_of(set, row), reach, &mut disc, y);
        }
    }
    disc
}

/// Adds to row `y` of `disc` whatever lies within `reach` columns of a pixel of `source`.
fn widen(source: &[bool], reach: u32, disc: &mut Raster<bool>, y: u32) {
    let start = y as usize * disc.width as usize;
    let target = &mut disc.pixels[start..start + source.len()];
    let mut free = 0;
    for column in (0..source.len()).filter(|column| source[*column]) {
        let from = column.saturating_sub(reach as usize).max(free);
        free = (column + reach as usize + 1).min(source.len());
        target[from..free.max(from)].fill(true);
    }
}

fn row_of(set: &Raster<bool>, row: u32) -> &[bool] {
    let width = set.width as usize;
    &set.pixels[row as usize * width..][..width]
}

/// The root mean square error of a region's mean of halves, from their difference alone: with independent halves the
/// expectation of `(A - B)^2 / 4` is the squared error of `(A + B) / 2`. None where the region is empty.
pub(crate) fn noise_floor(halves: [&Image; 2], regions: &Regions, region: Region) -> Option<f64> {
    let [a, b] = halves;
    let squares = a.zip(b, |a, b| {
        let square = |c: usize| (f64::from(a[c]) - f64::from(b[c])).powi(2);
        (square(0) + square(1) + square(2)) / 3.0
    });
    let inside = regions.select(region, &squares);
    let mean = inside.iter().sum::<f64>() / inside.len() as f64;
    (!inside.is_empty()).then(|| (mean / 4.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_floor_is_half_of_what_the_halves_differ_by_in_each_region() {
        let moving = Raster::from_fn(4, 1, |x, _| x == 3);
        let still = moving.map(|moves| !moves);
        let a = Raster::filled(4, 1, [0.5; 3]);
        let b = Raster::from_fn(4, 1, |x, _| {
            if x == 3 {
                [0.5 - 0.2; 3]
            } else {
                [0.5, 0.5, 0.5 + 0.06]
            }
        });
        let regions = Regions {
            knowable: moving.clone(),
            unknowable: moving.map(|_| false),
            support: moving.clone(),
            moving,
            still,
        };
        let floor = |region| noise_floor([&a, &b], &regions, region).unwrap();
        let one_of_three = 0.03 / 3.0_f64.sqrt();
        let all = ((0.1_f64.powi(2) + 3.0 * one_of_three.powi(2)) / 4.0).sqrt();
        for (region, expected) in [
            (Region::Moving, 0.1),
            (Region::Support, 0.1),
            (Region::Still, one_of_three),
            (Region::Full, all),
            (Region::Knowable, 0.1),
        ] {
            // Colours are rounded to f32.
            assert!(
                (floor(region) - expected).abs() < 1e-7,
                "{region}: {}",
                floor(region)
            );
        }
        assert_eq!(noise_floor([&a, &b], &regions, Region::Unknowable), None);
    }

    #[test]
    fn a_set_grows_by_the_disc_around_each_of_its_pixels() {
        let set = Raster::from_fn(23, 17, |x, y| {
            (x * 7 + y * 13) % 61 == 5 || (x, y) == (22, 16)
        });
        for radius in [0, 1, 2, 5] {
            let expected = Raster::from_fn(23, 17, |x, y| {
                (0..17).any(|v| {
                    (0..23).any(|u| {
                        let squared = u32::abs_diff(u, x).pow(2) + u32::abs_diff(v, y).pow(2);
                        *set.at(u, v) && squared <= radius * radius
                    })
                })
            });
            assert_eq!(dilated(&set, radius), expected, "radius {radius}");
        }
    }
}
