//! Reading a raster at the pixels of another size.

use frame::Raster;

/// A raster's part that shows the picture.
#[derive(Clone, Copy)]
pub(crate) struct Extent {
    /// Columns and rows of the picture.
    pub picture: [u32; 2],
    /// Pixels beyond it on every side.
    pub band: u32,
}

impl Extent {
    /// Returns columns and rows of the raster.
    fn size(&self) -> [u32; 2] {
        self.picture.map(|side| side + 2 * self.band)
    }

    /// Finds the place of the centre of another raster's pixel along an axis, in pixels from this raster's corner.
    fn place(&self, axis: usize, other: &Extent, pixel: u32) -> f64 {
        let step = f64::from(self.picture[axis]) / f64::from(other.picture[axis]);
        (f64::from(pixel) + 0.5 - f64::from(other.band)) * step + f64::from(self.band)
    }
}

/// Gives each pixel of another size the pixel that its centre lies in.
pub(crate) fn read_nearest<T: Clone>(raster: &Raster<T>, from: Extent, to: Extent) -> Raster<T> {
    let [width, height] = to.size();
    let size = from.size();
    let pixel = |axis: usize, at: u32| {
        let place = from.place(axis, &to, at).floor().max(0.0);
        (place as u32).min(size[axis] - 1)
    };
    Raster::from_fn(width, height, |x, y| {
        raster.at(pixel(0, x), pixel(1, y)).clone()
    })
}

/// Interpolates between the four pixels around each centre of another size; the outermost pixels go on beyond the border.
pub(crate) fn read_bilinear<const N: usize>(
    raster: &Raster<[f32; N]>,
    from: Extent,
    to: Extent,
) -> Raster<[f32; N]> {
    let [width, height] = to.size();
    let size = from.size();
    let between = |axis: usize, at: u32| {
        let last = size[axis] - 1;
        let place = from.place(axis, &to, at) - 0.5;
        let place = place.clamp(0.0, f64::from(last));
        let first = place.floor() as u32;
        (
            first,
            (first + 1).min(last),
            (place - f64::from(first)) as f32,
        )
    };
    Raster::from_fn(width, height, |x, y| {
        let (left, right, across) = between(0, x);
        let (top, bottom, down) = between(1, y);
        let [upper, lower] = [top, bottom].map(|row| {
            let [a, b] = [left, right].map(|column| raster.at(column, row));
            std::array::from_fn::<f32, N, _>(|c| a[c] + across * (b[c] - a[c]))
        });
        std::array::from_fn(|c| upper[c] + down * (lower[c] - upper[c]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALL: Extent = Extent {
        picture: [4, 2],
        band: 1,
    };
    const LARGE: Extent = Extent {
        picture: [8, 6],
        band: 2,
    };

    /// Makes a ramp over the small raster, in pixels of the large picture.
    fn ramp() -> Raster<[f32; 2]> {
        Raster::from_fn(6, 4, |x, y| {
            [2.0 * (x as f32 + 0.5 - 1.0), 3.0 * (y as f32 + 0.5 - 1.0)]
        })
    }

    #[test]
    fn a_ramp_stays_a_ramp_between_pixel_centres() {
        let read = read_bilinear(&ramp(), SMALL, LARGE);
        assert_eq!((read.width, read.height), (12, 10));
        for (y, x) in (0..10).flat_map(|y| (0..12).map(move |x| (y, x))) {
            // The ramp ends at the centres of the outermost pixels.
            let place = [x as f32 + 0.5 - 2.0, y as f32 + 0.5 - 2.0];
            let expected = [place[0].clamp(-1.0, 9.0), place[1].clamp(-1.5, 7.5)];
            assert_eq!(*read.at(x, y), expected, "at {x}, {y}");
        }
        let same = read_bilinear(&ramp(), SMALL, SMALL);
        assert_eq!(same, ramp());
    }

    #[test]
    fn nearest_pixels_are_those_that_the_centres_lie_in() {
        let columns = Raster::from_fn(6, 4, |x, y| (x, y));
        let read = read_nearest(&columns, SMALL, LARGE);
        let row: Vec<u32> = (0..12).map(|x| read.at(x, 0).0).collect();
        assert_eq!(row, [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5]);
        let column: Vec<u32> = (0..10).map(|y| read.at(0, y).1).collect();
        assert_eq!(column, [0, 0, 1, 1, 1, 2, 2, 2, 3, 3]);
        // The centres of 7 pixels lie at 0.2, 0.6, 1.1, 1.5, 1.9, 2.4 and 2.8 of 3.
        let bare = |width| Extent {
            picture: [width, 1],
            band: 0,
        };
        let three = Raster::from_fn(3, 1, |x, _| x);
        assert_eq!(
            read_nearest(&three, bare(3), bare(7)).pixels,
            [0, 0, 1, 1, 1, 2, 2]
        );
    }
}
