//! Patches: the part of a map that is not zero.

use frame::{Plane, Raster};

/// A rectangle of a map that is zero elsewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Column of the first pixel.
    pub left: u32,
    /// Row of the first pixel.
    pub top: u32,
    /// The pixels.
    pub raster: Raster<f64>,
}

impl Patch {
    /// Cuts the nonzero part out of a matte, with a margin as far as the picture reaches; `None` if
    /// all of it is zero.
    pub fn cut(matte: &Plane, margin: u32) -> Option<Self> {
        let width = matte.width as usize;
        let (mut columns, mut rows) = ((width, 0), (u32::MAX, 0));
        for (y, row) in (0..).zip(matte.pixels.chunks_exact(width)) {
            let Some(first) = row.iter().position(|value| *value != 0.0) else {
                continue;
            };
            let last = row.iter().rposition(|value| *value != 0.0);
            columns = (columns.0.min(first), columns.1.max(last.unwrap_or(first)));
            rows = (rows.0.min(y), y);
        }
        if rows.0 > rows.1 {
            return None;
        }
        let left = (columns.0 as u32).saturating_sub(margin);
        let top = rows.0.saturating_sub(margin);
        let right = (columns.1 as u32 + 1 + margin).min(matte.width);
        let bottom = (rows.1 + 1 + margin).min(matte.height);
        Some(Self {
            left,
            top,
            raster: Raster::from_fn(right - left, bottom - top, |x, y| {
                f64::from(*matte.at(left + x, top + y))
            }),
        })
    }

    /// Makes the patch that covers both, each pixel from theirs.
    pub fn zip(
        one: Option<&Self>,
        other: Option<&Self>,
        value: impl Fn(f64, f64) -> f64,
    ) -> Option<Self> {
        let both = || one.into_iter().chain(other);
        let left = both().map(|patch| patch.left).min()?;
        let top = both().map(|patch| patch.top).min()?;
        let right = both().map(|patch| patch.left + patch.raster.width).max()?;
        let bottom = both().map(|patch| patch.top + patch.raster.height).max()?;
        let at = |patch: Option<&Self>, x, y| patch.map_or(0.0, |patch| patch.at(x, y));
        Some(Self {
            left,
            top,
            raster: Raster::from_fn(right - left, bottom - top, |x, y| {
                let (x, y) = (left + x, top + y);
                value(at(one, x, y), at(other, x, y))
            }),
        })
    }

    /// Iterates over the pixels row by row, each with its index into a picture of this width.
    pub fn pixels(&self, width: u32) -> impl Iterator<Item = (usize, f64)> {
        let rows = self.raster.pixels.chunks_exact(self.raster.width as usize);
        (self.top..).zip(rows).flat_map(move |(y, row)| {
            let start = y as usize * width as usize + self.left as usize;
            (start..).zip(row.iter().copied())
        })
    }

    fn at(&self, x: u32, y: u32) -> f64 {
        let (column, row) = (x.wrapping_sub(self.left), y.wrapping_sub(self.top));
        if column < self.raster.width && row < self.raster.height {
            *self.raster.at(column, row)
        } else {
            0.0
        }
    }
}
