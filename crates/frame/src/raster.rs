//! Rasters: two-dimensional arrays of pixels.

use rayon::prelude::*;

use crate::{Size, Tile};

/// Row-major pixels from the top left: pixel (x, y) is `pixels[y * width + x]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster<T> {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height` pixels.
    pub pixels: Vec<T>,
}

/// Scene-linear Rec.709 radiance.
pub type Image = Raster<[f32; 3]>;
/// One number per pixel: depth, coverage, an error map.
pub type Plane = Raster<f32>;
/// Screen vectors in pixels, +x right, +y down.
pub type Vectors = Raster<[f32; 2]>;

impl<T> Raster<T> {
    /// Returns its columns and rows.
    pub fn size(&self) -> Size {
        Size::new(self.width, self.height)
    }
}

impl<T: Clone> Raster<T> {
    /// Makes a raster that holds `value` everywhere.
    pub fn filled(width: u32, height: u32, value: T) -> Self {
        let pixels = vec![value; width as usize * height as usize];
        Self {
            width,
            height,
            pixels,
        }
    }

    /// Removes `border` pixels on every side. Panics if nothing would be left.
    pub fn cropped(&self, border: u32) -> Raster<T> {
        assert!(
            2 * border < self.width && 2 * border < self.height,
            "a border of {border} pixels leaves nothing"
        );
        self.part(Tile {
            x: border,
            y: border,
            width: self.width - 2 * border,
            height: self.height - 2 * border,
        })
    }

    /// Repeats the outermost pixels `margin` times on every side.
    pub fn widened(&self, margin: u32) -> Raster<T> {
        let inside = |place: u32, side: u32| place.saturating_sub(margin).min(side - 1);
        let [width, height] = [self.width, self.height];
        Raster::from_fn(width + 2 * margin, height + 2 * margin, |x, y| {
            self.at(inside(x, width), inside(y, height)).clone()
        })
    }

    /// Enlarges each pixel to a square of `factor` pixels a side.
    pub fn enlarged(&self, factor: u32) -> Raster<T> {
        let (width, height) = (self.width * factor, self.height * factor);
        Raster::from_fn(width, height, |x, y| {
            self.at(x / factor, y / factor).clone()
        })
    }

    /// Copies the pixels of a tile. Panics if it leaves the raster.
    pub fn part(&self, tile: Tile) -> Raster<T> {
        let [x, y, width, height] =
            [tile.x, tile.y, tile.width, tile.height].map(|number| number as usize);
        assert!(
            x + width <= self.width as usize,
            "{tile:?} leaves the raster"
        );
        let mut pixels = Vec::with_capacity(width * height);
        for row in y..y + height {
            pixels.extend_from_slice(&self.pixels[row * self.width as usize + x..][..width]);
        }
        Raster {
            width: tile.width,
            height: tile.height,
            pixels,
        }
    }
}

impl<T> Raster<T> {
    /// Makes a raster from `value(x, y)`, pixel by pixel and row by row.
    pub fn from_fn(width: u32, height: u32, mut value: impl FnMut(u32, u32) -> T) -> Self {
        let mut pixels = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            pixels.extend((0..width).map(|x| value(x, y)));
        }
        Self {
            width,
            height,
            pixels,
        }
    }

    /// Returns the pixel in column `x`, row `y`. Panics outside the raster.
    pub fn at(&self, x: u32, y: u32) -> &T {
        assert!(
            x < self.width && y < self.height,
            "pixel ({x}, {y}) is outside the raster"
        );
        &self.pixels[y as usize * self.width as usize + x as usize]
    }

    /// Makes a raster of the same size, each pixel from this one's.
    pub fn map<U>(&self, value: impl FnMut(&T) -> U) -> Raster<U> {
        Raster {
            width: self.width,
            height: self.height,
            pixels: self.pixels.iter().map(value).collect(),
        }
    }

    /// Makes a raster of the same size from each pair of pixels. Panics if the sizes differ.
    pub fn zip<U, V>(&self, other: &Raster<U>, mut value: impl FnMut(&T, &U) -> V) -> Raster<V> {
        assert!(
            self.same_size(other),
            "rasters of different sizes cannot be combined pixel by pixel"
        );
        let pixels = self
            .pixels
            .iter()
            .zip(&other.pixels)
            .map(|(a, b)| value(a, b))
            .collect();
        Raster {
            width: self.width,
            height: self.height,
            pixels,
        }
    }

    /// Returns true if both have the same width and height.
    pub fn same_size<U>(&self, other: &Raster<U>) -> bool {
        self.size() == other.size()
    }
}

impl Image {
    /// Makes an image of the first three of each pixel's four components.
    pub fn from_texels(texels: &Raster<[f32; 4]>) -> Self {
        texels.map(|[r, g, b, _]| [*r, *g, *b])
    }

    /// Makes four components per pixel: the colour times `scale`, and 1.
    pub fn to_texels(&self, scale: f32) -> Vec<f32> {
        let pixels = self.pixels.iter();
        (pixels.flat_map(|[r, g, b]| [scale * r, scale * g, scale * b, 1.0])).collect()
    }
}

/// Finds the first number that is infinite, NaN, or not above `least`.
pub fn find_broken(values: &[f32], least: f32) -> Option<usize> {
    values
        .iter()
        .position(|value| !(value.is_finite() && *value > least))
}

/// Averages at least one plane, all of one size; sums in `f64`, in their order.
pub(crate) fn mean_plane<'a>(planes: impl IntoIterator<Item = &'a Plane>) -> Plane {
    mean_of_planes(&planes.into_iter().collect::<Vec<_>>())
}

/// Averages rasters of several numbers per pixel in the same way.
pub(crate) fn mean_vectors<'a, const N: usize>(
    rasters: impl IntoIterator<Item = &'a Raster<[f32; N]>>,
) -> Raster<[f32; N]> {
    mean_of_vectors(&rasters.into_iter().collect::<Vec<_>>())
}

// Without the iterators of their callers, these are compiled once.

fn mean_of_planes(planes: &[&Plane]) -> Plane {
    gather(planes, |pixel| {
        mean_number(planes.iter().map(|plane| plane.pixels[pixel]))
    })
}

fn mean_of_vectors<const N: usize>(rasters: &[&Raster<[f32; N]>]) -> Raster<[f32; N]> {
    gather(rasters, |pixel| {
        std::array::from_fn(|component| {
            mean_number(rasters.iter().map(|raster| raster.pixels[pixel][component]))
        })
    })
}

/// Makes a raster of the size of all `rasters` from the pixels' indices.
pub(crate) fn gather<T: Send + Sync>(
    rasters: &[&Raster<T>],
    value: impl Fn(usize) -> T + Sync + Send,
) -> Raster<T> {
    let first = (rasters.first()).expect("at least one raster is gathered");
    assert!(
        rasters.iter().all(|raster| raster.same_size(first)),
        "rasters of one size are gathered"
    );
    Raster {
        width: first.width,
        height: first.height,
        pixels: (0..first.pixels.len()).into_par_iter().map(value).collect(),
    }
}

fn mean_number(values: impl ExactSizeIterator<Item = f32>) -> f32 {
    let count = values.len() as f64;
    (values.map(f64::from).sum::<f64>() / count) as f32
}
