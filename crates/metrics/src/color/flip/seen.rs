//! Pictures as the eye sees them, and their difference.

use frame::{Image, Plane};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::filter::{Exposure, LINES, RowFilter};
use super::space::{distance, largest_distance};
use super::weights::Weights;
use crate::math::power::power;

/// Rows that are filtered one after another: more make pictures of few rows wait for one thread, fewer filter more rows twice.
const BAND: usize = 64;

/// A picture as the eye sees it at one exposure.
pub struct Seen {
    /// Per row [`LINES`] lines.
    rows: Vec<f32>,
}

impl Seen {
    /// Filters a picture.
    pub fn new(image: &Image, exposure: Exposure) -> Self {
        let weights = Weights::new();
        let row = LINES * image.width as usize;
        let mut rows = vec![0.0; row * image.height as usize];
        let bands = rows.par_chunks_mut(BAND * row).enumerate();
        bands.for_each(|(band, rows)| {
            Arch::new().dispatch(FilterBand {
                filter: RowFilter::new(image, exposure, &weights, band * BAND),
                first: band * BAND,
                rows,
                row,
            });
        });
        Self { rows }
    }
}

/// Filters a band of rows.
struct FilterBand<'a> {
    filter: RowFilter<'a>,
    first: usize,
    rows: &'a mut [f32],
    row: usize,
}

impl WithSimd for FilterBand<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) {
        for (y, row) in (self.first..).zip(self.rows.chunks_exact_mut(self.row)) {
            let lines = self.filter.filter_row(y);
            for (target, line) in row.chunks_exact_mut(self.row / LINES).zip(lines) {
                target.copy_from_slice(line);
            }
        }
    }
}

/// Raises a map to the errors of a picture against a truth, where they are larger.
pub fn raise_to_errors(map: &mut Plane, truth: &Seen, image: &Image, exposure: Exposure) {
    let weights = Weights::new();
    let scale = ErrorScale::new();
    let width = image.width as usize;
    let bands = map.pixels.par_chunks_mut(BAND * width).enumerate();
    bands.for_each(|(band, errors)| {
        Arch::new().dispatch(CompareBand {
            filter: RowFilter::new(image, exposure, &weights, band * BAND),
            first: band * BAND,
            truth,
            errors,
            width,
            scale,
        });
    });
}

/// Filters and compares a band of rows.
struct CompareBand<'a> {
    filter: RowFilter<'a>,
    first: usize,
    truth: &'a Seen,
    errors: &'a mut [f32],
    width: usize,
    scale: ErrorScale,
}

impl WithSimd for CompareBand<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) {
        for (y, errors) in (self.first..).zip(self.errors.chunks_exact_mut(self.width)) {
            let truth = &self.truth.rows[y * LINES * self.width..][..LINES * self.width];
            let seen = self.filter.filter_row(y);
            self.scale.raise(errors, truth, seen);
        }
    }
}

/// Scale of FLIP's errors of colour.
#[derive(Clone, Copy)]
struct ErrorScale {
    /// Error of green against blue, the largest.
    largest: f32,
}

impl ErrorScale {
    fn new() -> Self {
        Self {
            largest: largest_distance(),
        }
    }

    /// Raises a line of errors to those of `seen` against the truth's lines, where they are larger.
    #[inline(always)]
    fn raise(self, errors: &mut [f32], truth: &[f32], seen: [&[f32]; LINES]) {
        /// Part of the largest distance up to which errors are spread over all but a twentieth of the range.
        const NEAR: f32 = 0.4;
        const NEAR_RANGE: f32 = 0.95;
        let largest = self.largest;
        let near = NEAR * largest;
        let width = errors.len();
        let [l, a, b, edges, points] = [0, 1, 2, 3, 4].map(|line| &truth[line * width..][..width]);
        let [seen_l, seen_a, seen_b, seen_edges, seen_points] = seen.map(|line| &line[..width]);
        for at in 0..width {
            let apart = distance([l[at], a[at], b[at]], [seen_l[at], seen_a[at], seen_b[at]]);
            let apart = power(apart, 0.7);
            let color = match apart < near {
                true => apart * (NEAR_RANGE / near),
                false => NEAR_RANGE + ((apart - near) / (largest - near)) * (1.0 - NEAR_RANGE),
            };
            let edge = (edges[at] - seen_edges[at]).abs();
            let point = (points[at] - seen_points[at]).abs();
            let feature = (std::f32::consts::FRAC_1_SQRT_2 * edge.max(point)).sqrt();
            errors[at] = errors[at].max(power(color, 1.0 - feature));
        }
    }
}
