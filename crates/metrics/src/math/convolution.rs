//! Separable filters of pictures, with borders mirrored at the outer edges of the outermost pixels (d c b a | a b c d).

use frame::Raster;
use rayon::prelude::*;

/// Samples a Gaussian or its derivative at whole pixels up to `truncate` standard deviations, and divides by the sum of the
/// Gaussian's samples, as `scipy.ndimage.gaussian_filter1d` does.
pub fn gaussian(sigma: f64, truncate: f64, derivative: bool) -> Vec<f64> {
    let radius = (truncate * sigma + 0.5).floor() as i32;
    let bell = |x: i32| (-0.5 * (f64::from(x) / sigma).powi(2)).exp();
    let total: f64 = (-radius..=radius).map(bell).sum();
    (-radius..=radius)
        .map(|x| {
            let slope = match derivative {
                true => f64::from(x) / (sigma * sigma),
                false => 1.0,
            };
            slope * bell(x) / total
        })
        .collect()
}

/// Correlates rows with one kernel and columns with another; kernels have odd lengths.
pub fn filter_separably(map: &Raster<f64>, rows: &[f64], columns: &[f64]) -> Raster<f64> {
    let (width, height) = (map.width as usize, map.height as usize);
    let beyond = rows.len() / 2;
    let places: Vec<usize> = (0..width + 2 * beyond)
        .map(|at| mirror_index(at, beyond, width))
        .collect();
    let mut along = vec![0.0; map.pixels.len()];
    let lines = along.par_chunks_mut(width);
    lines.enumerate().for_each(|(y, sums)| {
        let line = &map.pixels[y * width..][..width];
        let padded: Vec<f64> = places.iter().map(|place| line[*place]).collect();
        for (offset, weight) in rows.iter().enumerate() {
            add_weighted(sums, *weight, &padded[offset..]);
        }
    });
    let beyond = columns.len() / 2;
    let mut both = Raster {
        pixels: vec![0.0; along.len()],
        ..*map
    };
    let lines = both.pixels.par_chunks_mut(width);
    lines.enumerate().for_each(|(y, sums)| {
        for (offset, weight) in columns.iter().enumerate() {
            let line = mirror_index(y + offset, beyond, height);
            add_weighted(sums, *weight, &along[line * width..]);
        }
    });
    both
}

/// Adds weighted values to sums, a whole line at a time, which compilers turn into wide instructions.
fn add_weighted(sums: &mut [f64], weight: f64, values: &[f64]) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += weight * value;
    }
}

/// Returns the index into a line of pixels, mirrored at its ends, of a place counted from `beyond` pixels before its start.
fn mirror_index(at: usize, beyond: usize, length: usize) -> usize {
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

    #[test]
    fn a_gaussian_keeps_what_is_even_and_its_derivative_tells_the_slope() {
        let slope = Raster::from_fn(40, 30, |x, y| 3.0 * f64::from(x) - 2.0 * f64::from(y));
        let (bell, derivative) = (gaussian(1.4, 4.0, false), gaussian(1.4, 4.0, true));
        let smooth = filter_separably(&slope, &bell, &bell);
        assert!((smooth.at(20, 15) - slope.at(20, 15)).abs() < 1e-12);
        let across = filter_separably(&slope, &derivative, &bell);
        let down = filter_separably(&slope, &bell, &derivative);
        // The sampled derivative is that of the Gaussian to a thousandth.
        assert!(
            (across.at(20, 15) / 3.0 - 1.0).abs() < 1e-3,
            "{}",
            across.at(20, 15)
        );
        assert!((down.at(20, 15) / -2.0 - 1.0).abs() < 1e-3);
    }
}
