//! Position and length of a blur along the motion.

use crate::object::rows::Grid;

/// Mass along the motion, compared with the truth row by row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misplacement {
    /// Mean distance along the motion that mass would have to travel to match the truth
    /// (Wasserstein-1), in pixels.
    pub distance: f64,
    /// Signed shift of the centre of all mass, in pixels; positive = ahead.
    pub centroid: f64,
    /// Standard deviation along the motion over the truth's: 1 = right length. None if negative
    /// mass, which a filter's noise makes, leaves no variance.
    pub extent: Option<f64>,
}

/// Compares rows. For `distance` and `extent` each row is normalised to a mass of 1, so that
/// lateral errors do not count. Rows are weighted by the truth's mass in them; rows that are empty
/// in either matte are left out. `centroid` compares the whole mattes. `None` if either matte has
/// no mass, no row is left, or the truth has no length along the motion.
pub fn measure_misplacement(output: &Grid, truth: &Grid) -> Option<Misplacement> {
    let centroid = output.center()? - truth.center()?;
    let (mut weight, mut distance) = (0.0, 0.0);
    let (mut variance, mut true_variance) = (0.0, 0.0);
    for (output, truth) in output.rows().zip(truth.rows()) {
        let (Some(moments), Some(expected)) = (measure_moments(output), measure_moments(truth))
        else {
            continue;
        };
        weight += expected.mass;
        distance += expected.mass * distance_between(output, moments.mass, truth, expected.mass);
        variance += expected.mass * moments.variance;
        true_variance += expected.mass * expected.variance;
    }
    (weight > 0.0 && true_variance > 0.0).then(|| Misplacement {
        distance: distance / weight,
        centroid,
        extent: (variance >= 0.0).then(|| (variance / true_variance).sqrt()),
    })
}

struct Moments {
    mass: f64,
    variance: f64,
}

fn measure_moments(row: &[f64]) -> Option<Moments> {
    // Less than a thousandth of a pixel in the whole row is rounding or noise: normalised, it would
    // count as a full row.
    const LEAST_MASS: f64 = 1e-3;
    let mass: f64 = row.iter().sum();
    if mass < LEAST_MASS {
        return None;
    }
    let cells = || {
        row.iter()
            .zip(0..)
            .map(|(m, cell)| (m / mass, f64::from(cell)))
    };
    let center: f64 = cells().map(|(m, s)| m * s).sum();
    let variance = cells().map(|(m, s)| m * (s - center).powi(2)).sum();
    Some(Moments { mass, variance })
}

/// Returns the Wasserstein-1 distance of two rows on a line: the area between their cumulative
/// sums.
fn distance_between(a: &[f64], a_mass: f64, b: &[f64], b_mass: f64) -> f64 {
    let mut ahead = 0.0;
    let mut area = 0.0;
    for (a, b) in a.iter().zip(b) {
        ahead += a / a_mass - b / b_mass;
        area += f64::abs(ahead);
    }
    area
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::object::rows::Rows;
    use frame::Raster;

    #[test]
    fn the_centroid_is_the_centre_of_all_mass_and_not_the_mean_of_rows() {
        let rows = Rows::new([1.0, 0.0], 20, 2);
        let truth = Raster::from_fn(20, 2, |x, _| if (4..8).contains(&x) { 0.5 } else { 0.0 });
        // The upper row has thrice its mass, 4 px ahead; the lower one is right.
        let output = Raster::from_fn(20, 2, |x, y| match y {
            0 if (6..14).contains(&x) => 0.75,
            1 if (4..8).contains(&x) => 0.5,
            _ => 0.0,
        });
        let misplacement = measure_misplacement(&rows.spread(&output), &rows.spread(&truth))
            .expect("both have mass");
        // 6 of 8 px of mass are 4 px ahead; the mean over rows would be 2. Exact in binary.
        assert_eq!(misplacement.centroid, 3.0);
        assert_eq!(misplacement.distance, 2.0);
    }

    #[test]
    fn a_row_of_a_hundredth_of_a_pixel_counts_and_one_of_rounding_does_not() {
        let rows = Rows::new([1.0, 0.0], 20, 3);
        let mass = [2.0, 0.01, 0.0005];
        let mattes = [4, 8].map(|start| {
            Raster::from_fn(20, 3, |x, y| match y {
                0 if (4..8).contains(&x) => mass[0] / 4.0,
                1 | 2 if (start..start + 4).contains(&x) => mass[y as usize] / 4.0,
                _ => 0.0,
            })
        });
        let [truth, output] = mattes.map(|matte| rows.spread(&matte));
        let misplacement = measure_misplacement(&output, &truth).expect("both have mass");
        // The second row is 4 px ahead, and so is the third, which is left out. Mattes have 32
        // bits.
        assert!(
            (misplacement.distance - 0.04 / 2.01).abs() < 1e-6,
            "{misplacement:?}"
        );
    }

    #[test]
    fn negative_mass_far_away_leaves_no_length() {
        let rows = Rows::new([1.0, 0.0], 20, 1);
        let truth = Raster::from_fn(20, 1, |x, _| if (8..12).contains(&x) { 0.5 } else { 0.0 });
        let output = Raster::from_fn(20, 1, |x, _| match x {
            8..12 => 0.5,
            0 | 19 => -0.25,
            _ => 0.0,
        });
        let misplacement = measure_misplacement(&rows.spread(&output), &rows.spread(&truth))
            .expect("both have mass");
        assert_eq!(misplacement.extent, None);
        assert!(
            misplacement.distance > 0.0 && misplacement.centroid == 0.0,
            "{misplacement:?}"
        );
    }

    #[test]
    fn the_extent_is_a_ratio_of_standard_deviations() {
        let rows = Rows::new([1.0, 0.0], 20, 1);
        let [truth, output] = [4, 8].map(|length| {
            rows.spread(&Raster::from_fn(20, 1, |x, _| match x {
                4.. if x < 4 + length => 0.5,
                _ => 0.0,
            }))
        });
        let extent = measure_misplacement(&output, &truth)
            .unwrap()
            .extent
            .unwrap();
        // A box of n cells has a variance of (n^2 - 1) / 12.
        assert!((extent - (63f64 / 15.0).sqrt()).abs() < 1e-12, "{extent}");
    }
}
