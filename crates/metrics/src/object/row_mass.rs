//! Mass that rows along the motion gain and lose: growth, gain and loss.

use crate::object::rows::Grid;

/// Differences of the mass of rows along the motion from the truth's, in pixels of lateral
/// silhouette.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowMass {
    /// Mass added by a silhouette that grew sideways.
    pub growth: f64,
    /// Mass that the silhouette's own rows gain together.
    pub gain: f64,
    /// Mass that rows lack.
    pub loss: f64,
}

/// Rows of an object at the instant, free of the truth's noise.
pub struct InstantRows {
    /// Part of each row's height that the silhouette covers, from 0 to 1.
    heights: Vec<f64>,
    /// True for rows that are about as heavy as the heaviest.
    heavy: Vec<bool>,
    /// Mass of the heaviest, in pixels.
    heaviest: f64,
}

/// Least mass of the rows that measure the gain of all rows, over the mass of the heaviest. They
/// are so near a round object's widest place that growing sideways adds nothing there.
const HEAVY: f64 = 0.99;

/// Gain that is granted by half, over the mass of the heaviest row. Larger gains are granted almost
/// whole, smaller ones hardly: they may be noise.
const HALF_GRANTED: f64 = 0.01;

impl InstantRows {
    /// Measures the rows of the instant's matte.
    pub fn new(instant: &Grid) -> Self {
        let masses = instant.row_masses();
        let heaviest = masses.iter().copied().fold(0.0, f64::max);
        Self {
            heights: instant.heights(),
            heavy: masses
                .iter()
                .map(|mass| *mass >= HEAVY * heaviest)
                .collect(),
            heaviest,
        }
    }

    /// Computes the gain granted to a row that the silhouette covers in its whole height, from the
    /// gain of each row.
    fn grant(&self, gained: &[f64]) -> f64 {
        let heavy = gained.iter().zip(&self.heavy);
        let heavy: Vec<f64> = heavy
            .filter_map(|(gained, heavy)| heavy.then_some(*gained))
            .collect();
        let gained = heavy.iter().sum::<f64>() / heavy.len() as f64;
        let least = HALF_GRANTED * self.heaviest;
        if gained > 0.0 {
            // Smooth where it begins, so that intervals of scores are valid.
            gained.powi(3) / (gained.powi(2) + least.powi(2))
        } else {
            0.0
        }
    }
}

impl RowMass {
    /// Compares rows. A translation only shifts mass along its rows, so that rows keep their mass
    /// for any length or side of the blur; a silhouette of `length` pixels (both sides together)
    /// that is dilated by d pixels adds `d * length` of mass.
    ///
    /// A row that is covered in its whole height may gain as much as the heaviest rows did, and
    /// others in proportion: that is gain. Everything above it is growth: all mass in rows that the
    /// silhouette does not touch, and mass that fills rows at its rim.
    pub fn new(output: &Grid, truth: &Grid, instant: &InstantRows, length: f64) -> Self {
        let (output, truth) = (output.row_masses(), truth.row_masses());
        let gained: Vec<f64> = output
            .iter()
            .zip(&truth)
            .map(|(output, truth)| output - truth)
            .collect();
        let granted = instant.grant(&gained);
        let (mut growth, mut gain, mut loss) = (0.0, 0.0, 0.0);
        for (gained, height) in gained.iter().zip(&instant.heights) {
            let more = gained.max(0.0);
            let within = more.min(granted * height);
            gain += within;
            growth += more - within;
            loss += (-gained).max(0.0);
        }
        Self {
            growth: growth / length,
            gain: gain / length,
            loss: loss / length,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::object::rows::Rows;
    use frame::Raster;

    /// Makes a bar of 20 columns that covers rows 10 to 20 of a picture and a third of row 9. Each
    /// row is `more` longer.
    fn bar(more: f64, top: f64) -> Grid {
        let matte = Raster::from_fn(60, 32, |x, y| {
            let height = (f64::from(y) + 1.0 - top).clamp(0.0, 1.0);
            let row = if y < 20 { height } else { 0.0 };
            let length = (20.0 + more + 10.0 - f64::from(x)).clamp(0.0, 1.0);
            (if x < 10 { 0.0 } else { row * length }) as f32
        });
        Rows::new([1.0, 0.0], 60, 32).spread(&matte)
    }

    const TRUE_TOP: f64 = 9.0 + 2.0 / 3.0;

    fn compare(more: f64, top: f64) -> RowMass {
        let truth = bar(0.0, TRUE_TOP);
        // Both lateral silhouettes of the bar are 20 px long.
        RowMass::new(&bar(more, top), &truth, &InstantRows::new(&truth), 40.0)
    }

    #[track_caller]
    fn assert_near(value: f64, expected: f64) {
        // Mattes are single-precision, and a hundredth of a gain of 2 px in 20 is not granted: 0.02
        // px in 10 rows of 40 px.
        assert!((value - expected).abs() < 0.006, "{value} for {expected}");
    }

    #[test]
    fn widening_and_gain_are_told_apart_but_for_the_row_at_the_rim() {
        let mass = compare(2.0, TRUE_TOP - 2.0);
        // Two rows of 22 px more on one side; the row at the rim is granted a third of the 2 px
        // that the others gain.
        let rim = 22.0 - 20.0 / 3.0 - 2.0 / 3.0;
        assert_near(mass.growth, (rim + 22.0 + 22.0 / 3.0) / 40.0);
        assert_near(mass.gain, (10.0 * 2.0 + 2.0 / 3.0) / 40.0);
    }

    #[test]
    fn only_rows_as_heavy_as_the_heaviest_measure_the_gain() {
        let rows = |lengths: [u32; 2]| {
            let matte = Raster::from_fn(60, 4, |x, y| match y {
                1 | 2 if x >= 10 && x < 10 + lengths[y as usize - 1] => 1.0,
                _ => 0.0,
            });
            Rows::new([1.0, 0.0], 60, 4).spread(&matte)
        };
        let truth = rows([20, 19]);
        let instant = InstantRows::new(&truth);
        // The shorter row grows alone: that is no gain of all rows.
        let mass = RowMass::new(&rows([20, 21]), &truth, &instant, 4.0);
        assert_eq!([mass.growth, mass.gain, mass.loss], [0.5, 0.0, 0.0]);
    }
}
