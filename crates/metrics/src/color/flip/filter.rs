//! Filters of one picture, row by row, as the eye filters it.

use frame::Image;
use pulp::Simd;

use super::space::{to_lab, to_opponent, tone_map};
use super::weights::Weights;
use crate::math::lines::{correlate, correlate_down};

/// Lines kept per row: three of CIELab, and the strengths of edges and of points.
pub const LINES: usize = 5;

/// Pixels that are filtered at a time: their sums stay in registers.
pub const LANES: usize = 64;

/// Sums of a pixel: four for contrast, and two each, along rows and columns, for edges and points.
const SUMS: usize = 8;

/// Lines of a row that was filtered along itself: four for contrast, three for features.
const FILTERED_ALONG: usize = 7;

/// Conversion of pixels to linear values in [0, 1].
#[derive(Clone, Copy)]
pub enum Exposure {
    /// They are linear already.
    Display,
    /// They are radiance, to be multiplied by this and mapped by the ACES curve.
    Factor(f32),
}

/// Filter of a picture's rows, from one row downwards.
pub struct RowFilter<'a> {
    image: &'a Image,
    exposure: Exposure,
    weights: &'a Weights,
    /// Pixels before and after a row that filters reach.
    reach: usize,
    /// Length of a line, a multiple of [`LANES`].
    stride: usize,
    /// Opponent colours of one row and its lightness from 0 to 1, with the outermost pixels
    /// repeated.
    padded: [Vec<f32>; 4],
    /// The last rows, filtered along themselves, as many as filters reach over; each has the slot
    /// of its number.
    recent: Vec<f32>,
    /// First row that was not yet filtered along itself.
    next: usize,
    lines: [Vec<f32>; LINES],
}

impl<'a> RowFilter<'a> {
    /// Makes a filter that begins with row `first`.
    pub fn new(image: &'a Image, exposure: Exposure, weights: &'a Weights, first: usize) -> Self {
        let reach = weights.contrast[0].len() / 2;
        let stride = Self::stride(image);
        Self {
            image,
            exposure,
            weights,
            reach,
            stride,
            padded: [(); 4].map(|()| vec![0.0; stride + 2 * reach]),
            recent: vec![0.0; (2 * reach + 1) * FILTERED_ALONG * stride],
            next: first.saturating_sub(reach),
            lines: [(); LINES].map(|()| vec![0.0; stride]),
        }
    }

    /// Returns the length of a line: the least multiple of [`LANES`] that a row fits in.
    pub fn stride(image: &Image) -> usize {
        (image.width as usize).next_multiple_of(LANES)
    }

    /// Filters row `y`, which follows the last one; returns its lines.
    #[inline(always)]
    pub fn filter_row<S: Simd>(&mut self, simd: S, y: usize) -> &[Vec<f32>; LINES] {
        let last = self.image.height as usize - 1;
        while self.next <= (y + self.reach).min(last) {
            self.filter_along(simd, self.next);
            self.next += 1;
        }
        let slots = 2 * self.reach + 1;
        // The outermost row is repeated beyond the border.
        let starts: Vec<usize> = (0..slots)
            .map(|tap| {
                let row = (y + tap).saturating_sub(self.reach).min(last);
                row % slots * FILTERED_ALONG * self.stride
            })
            .collect();
        for at in (0..self.stride).step_by(LANES) {
            self.filter_down(simd, &starts, at);
        }
        &self.lines
    }

    /// Filters row `y` along itself, and stores it among the recent rows.
    #[inline(always)]
    fn filter_along<S: Simd>(&mut self, simd: S, y: usize) {
        let width = self.image.width as usize;
        let row = &self.image.pixels[y * width..][..width];
        match self.exposure {
            Exposure::Display => self.convert(row, |value| value),
            Exposure::Factor(factor) => self.convert(row, |value| tone_map(value, factor)),
        }
        let Weights { contrast, feature } = self.weights;
        let slot = y % (2 * self.reach + 1);
        let recent = &mut self.recent[slot * FILTERED_ALONG * self.stride..];
        let [lightness, red_green, blue_yellow, normal] = &self.padded;
        let inset = self.reach - feature[0].len() / 2;
        let filtered: [(&[f32], &[f32]); FILTERED_ALONG] = [
            (&contrast[0], lightness),
            (&contrast[1], red_green),
            (&contrast[2], blue_yellow),
            (&contrast[3], blue_yellow),
            (&feature[0], &normal[inset..]),
            (&feature[1], &normal[inset..]),
            (&feature[2], &normal[inset..]),
        ];
        for ((taps, values), line) in filtered
            .into_iter()
            .zip(recent.chunks_exact_mut(self.stride))
        {
            correlate::<S, f32, LANES>(simd, taps, values, line);
        }
    }

    /// Converts a row to opponent colours, and repeats its outermost pixels.
    #[inline(always)]
    fn convert(&mut self, row: &[[f32; 3]], expose: impl Fn(f32) -> f32) {
        let (reach, width) = (self.reach, row.len());
        let [lightness, red_green, blue_yellow, normal] = &mut self.padded;
        let targets = lightness[reach..]
            .iter_mut()
            .zip(&mut red_green[reach..])
            .zip(&mut blue_yellow[reach..])
            .zip(&mut normal[reach..]);
        for ([red, green, blue], (((l, r), b), n)) in row.iter().zip(targets) {
            let opponent = to_opponent([expose(*red), expose(*green), expose(*blue)]);
            *l = opponent[0];
            *r = opponent[1];
            *b = opponent[2];
            *n = opponent[0] * (1.0 / 116.0) + (16.0 / 116.0);
        }
        for line in &mut self.padded {
            let (first, last) = (line[reach], line[reach + width - 1]);
            line[..reach].fill(first);
            line[reach + width..].fill(last);
        }
    }

    /// Filters columns from `at` on; recent rows begin at `starts`.
    #[inline(always)]
    fn filter_down<S: Simd>(&mut self, simd: S, starts: &[usize], at: usize) {
        let Weights { contrast, feature } = self.weights;
        let (recent, stride) = (&self.recent[at..], self.stride);
        let near = &starts[self.reach - feature[0].len() / 2..];
        let sums: [(&[f32], &[usize], usize); SUMS] = [
            (&contrast[0], starts, 0),
            (&contrast[1], starts, 1),
            (&contrast[2], starts, 2),
            (&contrast[3], starts, 3),
            (&feature[0], near, 5),
            (&feature[1], near, 4),
            (&feature[0], near, 6),
            (&feature[2], near, 4),
        ];
        let mut filtered = [[0.0; LANES]; SUMS];
        for ((taps, starts, line), filtered) in sums.into_iter().zip(&mut filtered) {
            *filtered = correlate_down(simd, taps, &recent[line * stride..], starts);
        }
        let [
            lightness,
            red_green,
            wide,
            narrow,
            right,
            down,
            bend_right,
            bend_down,
        ] = filtered;
        let mut lab = [lightness, red_green, wide];
        for (sum, part) in lab[2].iter_mut().zip(&narrow) {
            *sum += part;
        }
        to_lab(&mut lab);
        let (mut edges, mut points) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            edges[lane] = (right[lane] * right[lane] + down[lane] * down[lane]).sqrt();
        }
        for lane in 0..LANES {
            let (right, down) = (bend_right[lane], bend_down[lane]);
            points[lane] = (right * right + down * down).sqrt();
        }
        let values = lab.iter().chain([&edges, &points]);
        for (line, values) in self.lines.iter_mut().zip(values) {
            line[at..at + LANES].copy_from_slice(values);
        }
    }
}
