//! Separable filters of pictures, with borders mirrored at the outer edges of the outermost pixels
//! (d c b a | a b c d).

use frame::Raster;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::lines::{correlate, correlate_down};

/// Samples a Gaussian or its derivative at whole pixels up to `truncate` standard deviations, and
/// divides by the sum of the Gaussian's samples, as `scipy.ndimage.gaussian_filter1d` does.
pub fn gaussian(sigma: f64, truncate: f64, derivative: bool) -> Vec<f64> {
    let radius = (truncate * sigma + 0.5).floor() as i32;
    let bell = |x: i32| (-0.5 * (f64::from(x) / sigma).powi(2)).exp();
    let total: f64 = (-radius..=radius).map(bell).sum();
    (-radius..=radius)
        .map(|x| {
            let slope = if derivative {
                f64::from(x) / (sigma * sigma)
            } else {
                1.0
            };
            slope * bell(x) / total
        })
        .collect()
}

/// Pixels that are filtered at a time: their sums stay in registers.
pub const LANES: usize = 32;

/// Rows that are filtered one after another.
const BAND: usize = 32;

/// Correlates rows with one kernel and columns with another; kernels have odd lengths.
pub fn filter_separably(map: &Raster<f64>, rows: &[f64], columns: &[f64]) -> Raster<f64> {
    let width = map.width as usize;
    let stride = width.next_multiple_of(LANES);
    let places = mirrored_places(width, rows.len() / 2);
    let mut along = vec![0.0; stride * map.height as usize];
    let bands = along.par_chunks_mut(BAND * stride).enumerate();
    bands.for_each(|(band, lines)| {
        Arch::new().dispatch(Along {
            taps: rows,
            places: &places,
            values: &map.pixels[band * BAND * width..],
            width,
            lines,
        });
    });
    let mut both = Raster {
        pixels: vec![0.0; map.pixels.len()],
        ..*map
    };
    let bands = both.pixels.par_chunks_mut(BAND * width).enumerate();
    bands.for_each(|(band, lines)| {
        Arch::new().dispatch(Down {
            taps: columns,
            first: band * BAND,
            values: &along,
            size: (width, map.height as usize),
            lines,
        });
    });
    both
}

/// Correlation of rows with taps.
struct Along<'a> {
    taps: &'a [f64],
    /// Column of each place of a row that is mirrored at its ends.
    places: &'a [usize],
    values: &'a [f64],
    width: usize,
    lines: &'a mut [f64],
}

impl WithSimd for Along<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let stride = self.width.next_multiple_of(LANES);
        let mut padded = vec![0.0; stride + self.taps.len() - 1];
        let rows = self.values.chunks_exact(self.width);
        for (row, line) in rows.zip(self.lines.chunks_exact_mut(stride)) {
            for (value, place) in padded.iter_mut().zip(self.places) {
                *value = row[*place];
            }
            correlate::<S, f64, LANES>(simd, self.taps, &padded, line);
        }
    }
}

/// Correlation of columns with taps, row by row.
struct Down<'a> {
    taps: &'a [f64],
    first: usize,
    values: &'a [f64],
    size: (usize, usize),
    lines: &'a mut [f64],
}

impl WithSimd for Down<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (width, height) = self.size;
        let stride = width.next_multiple_of(LANES);
        for (y, line) in (self.first..).zip(self.lines.chunks_exact_mut(width)) {
            let starts: Vec<usize> = (0..self.taps.len())
                .map(|tap| mirror_index(y + tap, self.taps.len() / 2, height) * stride)
                .collect();
            for (block, line) in line.chunks_mut(LANES).enumerate() {
                let sums: [f64; LANES] =
                    correlate_down(simd, self.taps, &self.values[block * LANES..], &starts);
                line.copy_from_slice(&sums[..line.len()]);
            }
        }
    }
}

/// Lists the columns of a row that is mirrored at its ends, from `beyond` pixels before it to
/// `beyond` after it.
pub fn mirrored_places(width: usize, beyond: usize) -> Vec<usize> {
    (0..width + 2 * beyond)
        .map(|at| mirror_index(at, beyond, width))
        .collect()
}

/// Returns the index into a line of pixels, mirrored at its ends, of a place counted from `beyond`
/// pixels before its start.
pub fn mirror_index(at: usize, beyond: usize, length: usize) -> usize {
    let period = 2 * length;
    let mirrored = (at + period * beyond.div_ceil(period) - beyond) % period;
    mirrored.min(period - 1 - mirrored)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_are_mirrored_as_often_as_it_takes() {
        let places: Vec<usize> = (0..11).map(|at| mirror_index(at, 4, 3)).collect();
        assert_eq!(places, [2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0]);
    }
}
