//! The pixels of a picture and of the guard band around it.

use frame::{Size, Tile};

use crate::pixel_grid::PixelGrid;

/// The size of a picture and of its guard band, which only frames have. Positions count from the
/// picture's top left corner: in the band they are negative or beyond the size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Canvas {
    /// Pixels per row of the picture.
    pub width: u32,
    /// Rows of the picture.
    pub height: u32,
    /// Pixels by which the rasters extend beyond the picture on every side.
    pub guard_band: u32,
    /// Size of the picture in the pixels that the camera's view counts in.
    pub view: Size,
    /// Width and height of a pixel, in pixels of the view.
    pub step: [f64; 2],
    /// Distance by which every pixel looks to the right of its place, and below it, in pixels.
    pub offset: [f64; 2],
}

impl Canvas {
    /// A picture without a band.
    pub fn bare(width: u32, height: u32) -> Self {
        Self::new(width, height, 0, &PixelGrid::of_picture(width, height))
    }

    /// A grid of pixels over a picture of `width` x `height`, with a band of pixels of the grid.
    pub fn new(width: u32, height: u32, guard_band: u32, grid: &PixelGrid) -> Self {
        Self {
            width: grid.size.width,
            height: grid.size.height,
            guard_band,
            view: Size::new(width, height),
            step: grid.step(width, height),
            offset: grid.offset,
        }
    }

    /// Pixels per row with the band.
    pub fn columns(&self) -> u32 {
        self.width + 2 * self.guard_band
    }

    /// Rows with the band.
    pub fn rows(&self) -> u32 {
        self.height + 2 * self.guard_band
    }

    /// The tile of all pixels, with the band.
    pub fn whole(&self) -> Tile {
        Tile::whole(self.columns(), self.rows())
    }

    /// Indices of all pixels, row by row.
    pub fn pixels(&self) -> Vec<u32> {
        (0..self.columns() * self.rows()).collect()
    }

    /// Returns true if a pixel is in the picture, not in the band around it.
    pub fn is_in_picture(&self, pixel: u32) -> bool {
        let [column, row] = [pixel % self.columns(), pixel / self.columns()]
            .map(|index| index.wrapping_sub(self.guard_band));
        column < self.width && row < self.height
    }

    /// The top left corner of a pixel.
    pub fn corner(&self, pixel: u32) -> [f64; 2] {
        [pixel % self.columns(), pixel / self.columns()]
            .map(|index| f64::from(index) - f64::from(self.guard_band))
    }

    /// The place in the camera's view of a place in a pixel, which counts from its top left corner.
    pub fn place(&self, pixel: u32, within: [f64; 2]) -> [f64; 2] {
        let corner = self.corner(pixel);
        [0, 1].map(|axis| self.step[axis] * (corner[axis] + within[axis] + self.offset[axis]))
    }

    /// The number that seeds a pixel. Inside the picture it does not depend on the guard band, and
    /// so neither do the random numbers.
    pub fn seed_number(&self, pixel: u32) -> u32 {
        if self.is_in_picture(pixel) {
            let [column, row] = self.corner(pixel).map(|place| place as u32);
            row * self.width + column
        } else {
            self.width * self.height + pixel
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn every_pixel_has_a_number_of_its_own() {
        let padded = Canvas {
            guard_band: 2,
            ..Canvas::bare(5, 3)
        };
        let numbers = padded.pixels().into_iter();
        let different: HashSet<u32> = numbers.map(|pixel| padded.seed_number(pixel)).collect();
        assert_eq!(different.len(), 9 * 7);
    }
}
