//! Regions of pixels that scores are pooled over, defined by the truth and never by the picture.

use crate::words::words;
use crate::{Image, Raster, Support};

/// A set of pixels that the truth defines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Region {
    /// Pixels where anything moved on screen while the shutter was open, and a margin for bleed
    /// around them.
    Moving,
    /// The same without the margin, which would dilute the errors of a thin smear.
    Support,
    /// Pixels where nothing moved: the picture there equals the instant's. `static` in names and
    /// files.
    Still,
    /// The whole picture. It is reported because readers expect it; a filter that does nothing
    /// looks good here.
    Full,
    /// Moving pixels where the frame of the instant shows everything that the shutter sees.
    Knowable,
    /// The other moving pixels. The frame does not show all that the shutter sees there, so every
    /// filter has to guess.
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

words! {
    Region {
        Moving => "moving",
        Support => "support",
        Still => "static",
        Full => "full",
        Knowable => "knowable",
        Unknowable => "unknowable",
    }
}

impl Regions {
    /// Makes the regions of a support, which the noise of a truth does not change. The moving
    /// region is dilated by `margin` pixels, because bleed leaves the support.
    pub(crate) fn new(support: &Support, margin: u32) -> Self {
        let hidden = &support.unknowable;
        let moving = dilate(&support.moving, margin);
        Self {
            still: moving.map(|moves| !moves),
            knowable: moving.zip(hidden, |moves, hidden| *moves && !hidden),
            unknowable: moving.zip(hidden, |moves, hidden| *moves && *hidden),
            support: support.moving.clone(),
            moving,
        }
    }

    /// Returns the pixels of a region; `None` for the whole picture.
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

    /// Returns the values of `map` inside a region, in row order.
    pub fn select<T: Copy>(&self, region: Region, map: &Raster<T>) -> Vec<T> {
        assert!(
            self.moving.same_size(map),
            "a map is pooled over regions of its own size"
        );
        self.indices(region).map(|at| map.pixels[at]).collect()
    }

    /// Iterates over the indices of a region's pixels, in row order.
    pub fn indices(&self, region: Region) -> impl Iterator<Item = usize> {
        let mask = self.mask(region);
        (0..self.moving.pixels.len()).filter(move |at| mask.is_none_or(|mask| mask.pixels[*at]))
    }
}

/// Marks every pixel with its centre within `radius` pixels of the centre of a pixel of `set`.
pub(crate) fn dilate(set: &Raster<bool>, radius: u32) -> Raster<bool> {
    let mut disc = Raster::filled(set.width, set.height, false);
    let rows = set.pixels.chunks_exact(set.width as usize);
    let rows: Vec<Vec<usize>> = rows
        .map(|row| (0..row.len()).filter(|column| row[*column]).collect())
        .collect();
    for y in 0..set.height {
        for row in y.saturating_sub(radius)..=(y + radius).min(set.height - 1) {
            let half_width = (radius * radius - y.abs_diff(row).pow(2)).isqrt();
            widen(&rows[row as usize], half_width, &mut disc, y);
        }
    }
    disc
}

/// Marks in row `y` of `disc` the pixels within `half_width` columns of one of `columns`, which
/// rise.
fn widen(columns: &[usize], half_width: u32, disc: &mut Raster<bool>, y: u32) {
    let width = disc.width as usize;
    let target = &mut disc.pixels[y as usize * width..][..width];
    let mut free = 0;
    for column in columns {
        let from = column.saturating_sub(half_width as usize).max(free);
        free = (column + half_width as usize + 1).min(width);
        target[from..free.max(from)].fill(true);
    }
}

/// Estimates the root mean square error of the mean of two halves over a region; `None` if the
/// region is empty. With independent halves the expectation of `(A - B)^2 / 4` is the squared error
/// of `(A + B) / 2`.
pub(crate) fn estimate_noise(
    halves: [&Image; 2],
    regions: &Regions,
    region: Region,
) -> Option<f64> {
    let [a, b] = halves;
    let (mut sum, mut count) = (0.0, 0_u32);
    for at in regions.indices(region) {
        let (a, b) = (a.pixels[at], b.pixels[at]);
        let square = |c: usize| (f64::from(a[c]) - f64::from(b[c])).powi(2);
        sum += (square(0) + square(1) + square(2)) / 3.0;
        count += 1;
    }
    (count > 0).then(|| (sum / f64::from(count) / 4.0).sqrt())
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
        let floor = |region| estimate_noise([&a, &b], &regions, region).unwrap();
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
        assert_eq!(estimate_noise([&a, &b], &regions, Region::Unknowable), None);
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
            assert_eq!(dilate(&set, radius), expected, "radius {radius}");
        }
    }
}
