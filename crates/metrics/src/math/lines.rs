//! Correlations of lines with taps, a block of pixels at a time whose sums stay in registers.
//!
//! Everything is inlined into the caller, so that it gets the instructions that the caller was made for. Products are added one by
//! one in the order of the taps: wider instructions change no bit.

use std::ops::{AddAssign, Mul};

/// A number that is summed.
pub trait Number: Copy + Default + AddAssign + Mul<Output = Self> {}

impl<T: Copy + Default + AddAssign + Mul<Output = T>> Number for T {}

/// Correlates a line, whose length is a multiple of `LANES`; `values` begins as far before the line as the taps reach.
#[inline(always)]
pub fn correlate<T: Number, const LANES: usize>(taps: &[T], values: &[T], line: &mut [T]) {
    for (block, sums) in line.chunks_exact_mut(LANES).enumerate() {
        let values = &values[block * LANES..][..LANES + taps.len() - 1];
        let mut block = [T::default(); LANES];
        for (tap, values) in taps.iter().zip(values.windows(LANES)) {
            add_weighted(&mut block, *tap, values);
        }
        sums.copy_from_slice(&block);
    }
}

/// Correlates `LANES` columns; `starts` are where their rows begin in `values`, one per tap.
#[inline(always)]
pub fn correlate_down<T: Number, const LANES: usize>(
    taps: &[T],
    values: &[T],
    starts: &[usize],
) -> [T; LANES] {
    let mut sums = [T::default(); LANES];
    for (tap, start) in taps.iter().zip(starts) {
        add_weighted(&mut sums, *tap, &values[*start..][..LANES]);
    }
    sums
}

#[inline(always)]
fn add_weighted<T: Number, const LANES: usize>(sums: &mut [T; LANES], tap: T, values: &[T]) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += tap * *value;
    }
}
