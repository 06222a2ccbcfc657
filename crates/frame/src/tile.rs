//! Tiles: rectangles of pixels of a picture.

use crate::Size;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Column of its left pixels.
    pub x: u32,
    /// Row of its top pixels.
    pub y: u32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Tile {
    /// Makes the tile of a whole picture.
    pub fn whole(width: u32, height: u32) -> Self {
        Self {
            x: 0,
            y: 0,
            width,
            height,
        }
    }

    /// Makes a square tile around a place, moved and cut to fit a picture of `size`.
    pub fn around(place: [u32; 2], side: u32, size: Size) -> Self {
        let whole: [u32; 2] = size.into();
        let [width, height] = whole.map(|whole| whole.min(side));
        let start =
            |middle: u32, size: u32, whole: u32| middle.saturating_sub(size / 2).min(whole - size);
        Self {
            x: start(place[0], width, whole[0]),
            y: start(place[1], height, whole[1]),
            width,
            height,
        }
    }

    /// Lists the row-major indices of its pixels in a picture with this many columns, row by row.
    pub fn pixels(&self, columns: u32) -> Vec<u32> {
        let rows = self.y..self.y + self.height;
        rows.flat_map(|row| (self.x..self.x + self.width).map(move |x| row * columns + x))
            .collect()
    }

    /// Returns the index in the tile of a pixel of such a picture; none outside the tile.
    pub fn index_of(&self, pixel: u32, columns: u32) -> Option<usize> {
        let [x, y] = [
            (pixel % columns).checked_sub(self.x)?,
            (pixel / columns).checked_sub(self.y)?,
        ];
        let is_inside = x < self.width && y < self.height;
        is_inside.then_some((y * self.width + x) as usize)
    }
}
