//! Separable filters over pictures, with borders reflected about the outermost pixels' outer edges (d c b a | a b c d).

use frame::Raster;

/// A Gaussian, or its derivative, sampled at whole pixels up to `truncate` standard deviations and divided by the sum of the
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
pub fn separable(map: &Raster<f64>, rows: &[f64], columns: &[f64]) -> Raster<f64> {
    let (width, height) = (map.width, map.height);
    let along = Raster::from_fn(width, height, |x, y| {
        correlate(rows, x, width, |x| *map.at(x, y))
    });
    Raster::from_fn(width, height, |x, y| {
        correlate(columns, y, height, |y| *along.at(x, y))
    })
}

fn correlate(kernel: &[f64], at: u32, length: u32, value: impl Fn(u32) -> f64) -> f64 {
    let radius = (kernel.len() / 2) as i64;
    kernel
        .iter()
        .zip(-radius..)
        .map(|(weight, offset)| weight * value(reflected(i64::from(at) + offset, length)))
        .sum()
}

fn reflected(at: i64, length: u32) -> u32 {
    let period = 2 * i64::from(length);
    let folded = at.rem_euclid(period);
    folded.min(period - 1 - folded) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_are_reflected_as_often_as_it_takes() {
        let places: Vec<u32> = (-4..7).map(|at| reflected(at, 3)).collect();
        assert_eq!(places, [2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0]);
    }

    #[test]
    fn a_gaussian_keeps_what_is_even_and_its_derivative_tells_the_slope() {
        let slope = Raster::from_fn(40, 30, |x, y| 3.0 * f64::from(x) - 2.0 * f64::from(y));
        let (bell, derivative) = (gaussian(1.4, 4.0, false), gaussian(1.4, 4.0, true));
        let smooth = separable(&slope, &bell, &bell);
        assert!((smooth.at(20, 15) - slope.at(20, 15)).abs() < 1e-12);
        let across = separable(&slope, &derivative, &bell);
        let down = separable(&slope, &bell, &derivative);
        // The sampled derivative is that of the Gaussian to a thousandth.
        assert!(
            (across.at(20, 15) / 3.0 - 1.0).abs() < 1e-3,
            "{}",
            across.at(20, 15)
        );
        assert!((down.at(20, 15) / -2.0 - 1.0).abs() < 1e-3);
    }
}
