//! Rasters made from others pixel by pixel, on all threads.

use std::ops::Range;

use frame::Raster;
use rayon::prelude::*;

/// Pixels that a thread makes at once.
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
        pixels: make_parts(like.pixels.len(), &|part| part.map(&value).collect()),
    }
}

/// Makes pixels part by part, each from the range of their indices. No closure is a part of its
/// type, so that the code of threads is compiled once per type of pixel.
fn make_parts<U: Send>(
    count: usize,
    make: &(dyn Fn(Range<usize>) -> Vec<U> + Send + Sync),
) -> Vec<U> {
    if count <= PART {
        return make(0..count);
    }
    let starts: Vec<usize> = (0..count).step_by(PART).collect();
    let parts = (starts.par_iter()).map(|start| make(*start..(start + PART).min(count)));
    let parts: Vec<Vec<U>> = parts.collect();
    let mut pixels = Vec::with_capacity(count);
    for part in parts {
        pixels.extend(part);
    }
    pixels
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_large_raster_are_in_order_and_whole() {
        for count in [0, 1, PART, PART + 1, 3 * PART - 1] {
            let made = index_pixels(&Raster::filled(count as u32, 1, ()), |at| at);
            assert!(made.pixels.iter().copied().eq(0..count), "{count}");
        }
    }
}
