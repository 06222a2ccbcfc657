//! Rasters made from others pixel by pixel, on all threads.

use frame::Raster;
use rayon::prelude::*;

/// Fewest pixels worth a thread of their own.
const PART: usize = 1 << 14;

/// Makes a raster of the same size, each pixel from the other's.
pub fn map_pixels<T: Sync, U: Send>(
    raster: &Raster<T>,
    value: impl Fn(&T) -> U + Send + Sync,
) -> Raster<U> {
    index_pixels(raster, |at| value(&raster.pixels[at]))
}

/// Makes a raster of the same size, each pixel from both. Panics if the sizes differ.
pub fn zip_pixels<T: Sync, U: Sync, V: Send>(
    raster: &Raster<T>,
    other: &Raster<U>,
    value: impl Fn(&T, &U) -> V + Send + Sync,
) -> Raster<V> {
    assert!(
        raster.same_size(other),
        "rasters of different sizes cannot be combined pixel by pixel"
    );
    index_pixels(raster, |at| value(&raster.pixels[at], &other.pixels[at]))
}

/// Makes a raster of the same size, each pixel from its index.
pub fn index_pixels<T, U: Send>(
    like: &Raster<T>,
    value: impl Fn(usize) -> U + Send + Sync,
) -> Raster<U> {
    Raster {
        width: like.width,
        height: like.height,
        pixels: (0..like.pixels.len())
            .into_par_iter()
            .with_min_len(PART)
            .map(value)
            .collect(),
    }
}

/// Lists the indices of the pixels of a raster in the square around one, row by row.
pub fn around<T>(
    raster: &Raster<T>,
    at: usize,
    radius: usize,
) -> impl Iterator<Item = usize> + use<T> {
    let [width, height] = [raster.width as usize, raster.height as usize];
    let [x, y] = [at % width, at / width];
    let reach =
        |middle: usize, end: usize| middle.saturating_sub(radius)..=(middle + radius).min(end - 1);
    let (rows, columns) = (reach(y, height), reach(x, width));
    rows.flat_map(move |row| columns.clone().map(move |column| row * width + column))
}
