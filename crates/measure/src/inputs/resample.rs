//! Rasters read at another picture size.

use frame::{Raster, Size};

/// Part of a raster that shows the picture.
#[derive(Clone, Copy)]
pub(crate) struct Extent {
    /// Size of the picture.
    pub picture: Size,
    /// Pixels beyond it on every side.
    pub band: u32,
}

impl Extent {
    /// Returns the extent of a raster without a guard band.
    pub fn bare(picture: Size) -> Self {
        Self { picture, band: 0 }
    }

    /// Returns the size of the raster.
    fn size(&self) -> Size {
        self.picture.map(|side| side + 2 * self.band)
    }

    /// Finds the position of another raster's pixel centre along an axis, in pixels from this
    /// raster's corner.
    fn place(&self, axis: usize, other: &Extent, pixel: u32) -> f64 {
        let step = f64::from(self.picture.sides()[axis]) / f64::from(other.picture.sides()[axis]);
        (f64::from(pixel) + 0.5 - f64::from(other.band)) * step + f64::from(self.band)
    }
}

/// Gives each pixel of another size the pixel that contains its centre.
pub(crate) fn read_nearest<T: Clone>(raster: &Raster<T>, from: Extent, to: Extent) -> Raster<T> {
    let Size { width, height } = to.size();
    let size = from.size().sides();
    let pixel = |axis: usize, at: u32| {
        let place = from.place(axis, &to, at).floor().max(0.0);
        (place as u32).min(size[axis] - 1)
    };
    Raster::from_fn(width, height, |x, y| {
        raster.at(pixel(0, x), pixel(1, y)).clone()
    })
}

/// Interpolates between the four pixels around each centre of another size; the outermost pixels
/// continue beyond the border. `mix` interpolates between two values.
pub(crate) fn read_bilinear<T: Copy>(
    raster: &Raster<T>,
    from: Extent,
    to: Extent,
    mix: impl Fn(T, T, f32) -> T,
) -> Raster<T> {
    let Size { width, height } = to.size();
    let size = from.size().sides();
    let between = |axis: usize, at: u32| {
        let last = size[axis] - 1;
        let place = from.place(axis, &to, at) - 0.5;
        let place = place.clamp(0.0, f64::from(last));
        let first = place.floor() as u32;
        let next = (first + 1).min(last);
        (first, next, (place - f64::from(first)) as f32)
    };
    Raster::from_fn(width, height, |x, y| {
        let (left, right, across) = between(0, x);
        let (top, bottom, down) = between(1, y);
        let row = |row| mix(*raster.at(left, row), *raster.at(right, row), across);
        mix(row(top), row(bottom), down)
    })
}

/// Interpolates between two numbers.
pub(crate) fn mix(from: f32, to: f32, part: f32) -> f32 {
    from + part * (to - from)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALL: Extent = Extent {
        picture: Size::new(4, 2),
        band: 1,
    };
    const LARGE: Extent = Extent {
        picture: Size::new(8, 6),
        band: 2,
    };

    #[test]
    fn a_ramp_stays_a_ramp_between_pixel_centres() {
        // In pixels of the large picture; it ends at the centres of the outermost pixels.
        let ramp = Raster::from_fn(6, 4, |x, y| {
            2.0 * (x as f32 - 0.5) + 300.0 * (y as f32 - 0.5)
        });
        let read = read_bilinear(&ramp, SMALL, LARGE, mix);
        let expected = Raster::from_fn(12, 10, |x, y| {
            let place = [x, y].map(|at| at as f32 - 1.5);
            place[0].clamp(-1.0, 9.0) + 100.0 * place[1].clamp(-1.5, 7.5)
        });
        assert_eq!(read, expected);
        assert_eq!(read_bilinear(&ramp, SMALL, SMALL, mix), ramp);
    }

    #[test]
    fn nearest_pixels_are_those_that_the_centres_lie_in() {
        let columns = Raster::from_fn(6, 4, |x, y| (x, y));
        let read = read_nearest(&columns, SMALL, LARGE);
        let row: Vec<u32> = (0..12).map(|x| read.at(x, 0).0).collect();
        assert_eq!(row, [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5]);
        let column: Vec<u32> = (0..10).map(|y| read.at(0, y).1).collect();
        assert_eq!(column, [0, 0, 1, 1, 1, 2, 2, 2, 3, 3]);
        // The centres of 7 pixels are at 0.2, 0.6, 1.1, 1.5, 1.9, 2.4 and 2.8 of 3.
        let three = Raster::from_fn(3, 1, |x, _| x);
        let seven = read_nearest(
            &three,
            Extent::bare(Size::new(3, 1)),
            Extent::bare(Size::new(7, 1)),
        );
        assert_eq!(seven.pixels, [0, 0, 1, 1, 1, 2, 2]);
    }
}
