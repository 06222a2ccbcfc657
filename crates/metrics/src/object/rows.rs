//! Rows of a matte along a direction of motion, one pixel wide and side by side.

use frame::Plane;

/// A frame of rows parallel to a unit vector, laid over a picture of one size.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    along: [f64; 2],
    /// Place of the first cell of the first row, along and across the motion, in pixels.
    origin: [f64; 2],
    rows: usize,
    cells: usize,
}

/// A matte's mass in a frame of rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    cells: usize,
    /// Mass in square pixels, row by row.
    masses: Vec<f64>,
}

impl Rows {
    /// Makes rows along `along` (a unit vector) that cover every pixel of a `width` x `height`
    /// picture.
    pub fn new(along: [f64; 2], width: u32, height: u32) -> Self {
        let corners = [[0, 0], [width, 0], [0, height], [width, height]]
            .map(|corner| Self::coordinates(along, corner.map(f64::from)));
        let span = |axis: usize| {
            let values = corners.map(|corner| corner[axis]);
            let low = values.into_iter().fold(f64::INFINITY, f64::min).floor() - 1.0;
            let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max).ceil() + 1.0;
            (low, (high - low) as usize)
        };
        let ((s_low, cells), (t_low, rows)) = (span(0), span(1));
        Self {
            along,
            origin: [s_low, t_low],
            rows,
            cells,
        }
    }

    /// Converts a point to its place along and across the motion, in pixels.
    fn coordinates(along: [f64; 2], point: [f64; 2]) -> [f64; 2] {
        [
            along[0] * point[0] + along[1] * point[1],
            along[0] * point[1] - along[1] * point[0],
        ]
    }

    /// Spreads a matte over the rows. Across the motion each pixel is split exactly as its square
    /// overlaps the rows; along it, linearly between the two nearest cells, which keeps its mass
    /// and its centre.
    pub fn spread(&self, matte: &Plane) -> Grid {
        let mut grid = Grid {
            cells: self.cells,
            masses: vec![0.0; self.rows * self.cells],
        };
        // The shadow of a unit square across the motion is the convolution of two boxes of these
        // widths.
        let widths = self.along.map(f64::abs);
        let half = (widths[0] + widths[1]) / 2.0;
        for (index, &value) in matte.pixels.iter().enumerate() {
            if value == 0.0 {
                continue;
            }
            let (x, y) = (index % matte.width as usize, index / matte.width as usize);
            let center = [x as f64 + 0.5, y as f64 + 0.5];
            let [s, t] = Self::coordinates(self.along, center);
            let (s, t) = (s - self.origin[0] - 0.5, t - self.origin[1]);
            let cell = s.floor();
            let far = s - cell;
            let first = (t - half).floor();
            let mut below = 0.0;
            for row in first as usize..self.rows {
                let until = shadow_below(row as f64 + 1.0 - t, widths);
                let mass = f64::from(value) * (until - below);
                let start = row * self.cells + cell as usize;
                grid.masses[start] += mass * (1.0 - far);
                grid.masses[start + 1] += mass * far;
                below = until;
                if row as f64 + 1.0 >= t + half {
                    break;
                }
            }
        }
        grid
    }
}

impl Grid {
    /// Sums the total variation along the motion over the rows, in pixels of mass.
    pub fn total_variation(&self) -> f64 {
        let steps = |row: &[f64]| {
            row.windows(2)
                .map(|pair| (pair[1] - pair[0]).abs())
                .sum::<f64>()
        };
        self.rows().map(steps).sum()
    }

    /// Sums the mass of each row.
    pub fn row_masses(&self) -> Vec<f64> {
        self.rows().map(|row| row.iter().sum()).collect()
    }

    /// Measures the part of each row's height that the matte covers: the largest value in the row
    /// over the largest of all rows. It is 0 outside a silhouette, 1 within, and in between at its
    /// rim.
    pub fn heights(&self) -> Vec<f64> {
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let heights: Vec<f64> = self.rows().map(largest).collect();
        let whole = largest(&heights);
        if whole > 0.0 {
            heights.iter().map(|height| height / whole).collect()
        } else {
            heights
        }
    }

    /// Finds the centre of mass along the motion, in cells; `None` for a matte without mass.
    pub fn center(&self) -> Option<f64> {
        let (mut mass, mut moment) = (0.0, 0.0);
        for row in self.rows() {
            for (cell, place) in row.iter().zip(0..) {
                mass += cell;
                moment += cell * f64::from(place);
            }
        }
        (mass > 0.0).then(|| moment / mass)
    }

    /// Iterates over the rows from one side of the motion to the other, as mass per pixel of length
    /// along the motion.
    pub fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.masses.chunks_exact(self.cells)
    }
}

/// Returns the part of a unit square's shadow that is below `t` from its centre, in [0, 1].
fn shadow_below(t: f64, widths: [f64; 2]) -> f64 {
    let (narrow, wide) = (widths[0].min(widths[1]), widths[0].max(widths[1]));
    let (plateau, half) = ((wide - narrow) / 2.0, (wide + narrow) / 2.0);
    if t <= -half {
        0.0
    } else if t >= half {
        1.0
    } else if t < -plateau {
        (t + half).powi(2) / (2.0 * wide * narrow)
    } else if t > plateau {
        1.0 - (half - t).powi(2) / (2.0 * wide * narrow)
    } else {
        0.5 + t / wide
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use frame::Raster;

    fn unit(degrees: f64) -> [f64; 2] {
        [degrees.to_radians().cos(), degrees.to_radians().sin()]
    }

    #[test]
    fn spreading_keeps_mass_and_centre() {
        let matte = Raster::from_fn(23, 11, |x, y| ((x * 5 + y * 3) % 7) as f32 / 7.0);
        let mass: f64 = matte.pixels.iter().map(|a| f64::from(*a)).sum();
        for degrees in [0.0, 17.0, 30.0, 45.0, 90.0, 133.0, 180.0, 271.0] {
            let rows = Rows::new(unit(degrees), 23, 11);
            let grid = rows.spread(&matte);
            let spread: f64 = grid.masses.iter().sum();
            // Sums of 253 terms in f64.
            assert!(
                (spread - mass).abs() < 1e-10,
                "{degrees} degrees: {spread} for {mass}"
            );
            let along: f64 = grid
                .rows()
                .flat_map(|row| row.iter().zip(0..))
                .map(|(mass, cell)| mass * (f64::from(cell) + 0.5 + rows.origin[0]))
                .sum();
            let expected: f64 = (0..11)
                .flat_map(|y| (0..23).map(move |x| (x, y)))
                .map(|(x, y)| {
                    let center = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                    f64::from(*matte.at(x, y)) * Rows::coordinates(rows.along, center)[0]
                })
                .sum();
            assert!(
                (along - expected).abs() < 1e-8,
                "{degrees} degrees: {along} for {expected}"
            );
        }
    }

    #[test]
    fn a_uniform_picture_fills_slanted_rows_evenly() {
        let rows = Rows::new(unit(30.0), 60, 60);
        let grid = rows.spread(&Raster::filled(60, 60, 1.0));
        // The row through the picture's middle: its length is 60 / cos 30 degrees.
        let middle = (Rows::coordinates(rows.along, [30.0, 30.0])[1] - rows.origin[1]) as usize;
        let length: f64 = grid
            .rows()
            .nth(middle)
            .expect("the middle row exists")
            .iter()
            .sum();
        // Splitting across the row is exact; the pixels' beat along it is below 0.5 %.
        assert!(
            (length / (60.0 / 30f64.to_radians().cos()) - 1.0).abs() < 5e-3,
            "{length}"
        );
    }

    #[test]
    fn the_shadow_of_a_pixel_is_a_trapezium() {
        // The plateau reaches 0.1 to both sides, and the slopes 0.7.
        let below = |t| shadow_below(t, [0.6, 0.8]);
        for (t, expected) in [
            (0.0, 0.5),
            (0.1, 0.625),
            (0.4, 0.90625),
            (0.7, 1.0),
            (2.0, 1.0),
        ] {
            assert!((below(t) - expected).abs() < 1e-12, "{t}: {}", below(t));
            assert!(
                (below(-t) - (1.0 - expected)).abs() < 1e-12,
                "-{t}: {}",
                below(-t)
            );
        }
        assert_eq!(shadow_below(0.25, [1.0, 0.0]), 0.75);
    }
}
