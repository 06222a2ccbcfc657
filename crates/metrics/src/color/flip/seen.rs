//! Pictures as the eye sees them, and their difference.

use frame::{Image, Plane};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::filter::{Exposure, LANES, LINES, RowFilter};
use super::space::{distance, largest_distance};
use super::weights::Weights;
use crate::math::power::power;

/// Rows filtered by one thread: more leave threads idle on pictures of few rows, fewer filter more
/// rows twice.
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
        let row = LINES * RowFilter::stride(image);
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
    fn with_simd<S: Simd>(mut self, simd: S) {
        for (y, row) in (self.first..).zip(self.rows.chunks_exact_mut(self.row)) {
            let lines = self.filter.filter_row(simd, y);
            for (target, line) in row.chunks_exact_mut(self.row / LINES).zip(lines) {
                target.copy_from_slice(line);
            }
        }
    }
}

/// Raises a map to the errors of a picture against a truth, where they are larger.
pub fn raise_to_errors(map: &mut Plane, truth: &Seen, image: &Image, exposure: Exposure) {
    let weights = Weights::new();
    let largest = largest_distance();
    let width = image.width as usize;
    let bands = map.pixels.par_chunks_mut(BAND * width).enumerate();
    bands.for_each(|(band, errors)| {
        Arch::new().dispatch(CompareBand {
            filter: RowFilter::new(image, exposure, &weights, band * BAND),
            first: band * BAND,
            truth,
            errors,
            width,
            largest,
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
    /// Error of green against blue, the largest of all colours.
    largest: f32,
}

impl WithSimd for CompareBand<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        for (y, errors) in (self.first..).zip(self.errors.chunks_exact_mut(self.width)) {
            let seen = self.filter.filter_row(simd, y);
            let row = LINES * seen[0].len();
            let truth = &self.truth.rows[y * row..][..row];
            raise(self.largest, errors, truth, seen);
        }
    }
}

/// Raises a row of errors to those of `seen` against the truth's lines, where they are larger.
#[inline(always)]
fn raise(largest: f32, errors: &mut [f32], truth: &[f32], seen: &[Vec<f32>; LINES]) {
    let stride = seen[0].len();
    for (block, errors) in errors.chunks_mut(LANES).enumerate() {
        let at = block * LANES;
        let (mut one, mut other) = ([[0.0; LANES]; LINES], [[0.0; LANES]; LINES]);
        for line in 0..LINES {
            one[line].copy_from_slice(&truth[line * stride + at..][..LANES]);
            other[line].copy_from_slice(&seen[line][at..][..LANES]);
        }
        let found = compare(largest, &one, &other);
        for (error, found) in errors.iter_mut().zip(found) {
            *error = error.max(found);
        }
    }
}

/// Computes the errors of a block, step by step: compilers turn each step into wide instructions.
#[inline(always)]
fn compare(
    largest: f32,
    [l, a, b, edges, points]: &[[f32; LANES]; LINES],
    [seen_l, seen_a, seen_b, seen_edges, seen_points]: &[[f32; LANES]; LINES],
) -> [f32; LANES] {
    /// Distances up to this part of the largest are spread over 95 % of the range.
    const NEAR: f32 = 0.4;
    const NEAR_RANGE: f32 = 0.95;
    let near = NEAR * largest;
    let (mut color, mut exponents) = ([0.0; LANES], [0.0; LANES]);
    for lane in 0..LANES {
        color[lane] = distance(
            [l[lane], a[lane], b[lane]],
            [seen_l[lane], seen_a[lane], seen_b[lane]],
        );
    }
    for color in &mut color {
        *color = power(*color, 0.7);
    }
    for color in &mut color {
        let small = *color * (NEAR_RANGE / near);
        let large = NEAR_RANGE + ((*color - near) / (largest - near)) * (1.0 - NEAR_RANGE);
        *color = if *color < near { small } else { large };
    }
    for lane in 0..LANES {
        let edge = (edges[lane] - seen_edges[lane]).abs();
        let point = (points[lane] - seen_points[lane]).abs();
        let feature = std::f32::consts::FRAC_1_SQRT_2 * edge.max(point);
        exponents[lane] = 1.0 - feature.sqrt();
    }
    for (color, exponent) in color.iter_mut().zip(&exponents) {
        *color = power(*color, *exponent);
    }
    color
}
