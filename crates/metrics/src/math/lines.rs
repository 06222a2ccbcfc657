//! Correlations of lines with taps, by blocks of pixels whose sums stay in registers.
//!
//! Products are added one by one in the order of the taps: the width of the instructions changes no
//! bit. Everything is inlined into the caller, which pulp compiles for the instructions of the
//! processor.

use pulp::Simd;

/// A number with its instructions for several at a time.
pub trait Number<S: Simd>: Copy + Default {
    /// Several numbers.
    type Wide: Copy;

    /// Repeats a number.
    fn splat(self, simd: S) -> Self::Wide;

    /// Adds the products of both factors to sums.
    fn add_product(simd: S, sums: Self::Wide, a: Self::Wide, b: Self::Wide) -> Self::Wide;

    /// Reads as many numbers at a time as instructions take.
    fn widen(values: &[Self]) -> &[Self::Wide];

    /// Writes as many numbers at a time as instructions take.
    fn widen_mut(values: &mut [Self]) -> &mut [Self::Wide];
}

impl<S: Simd> Number<S> for f32 {
    type Wide = S::f32s;

    #[inline(always)]
    fn splat(self, simd: S) -> S::f32s {
        simd.splat_f32s(self)
    }

    #[inline(always)]
    fn add_product(simd: S, sums: S::f32s, a: S::f32s, b: S::f32s) -> S::f32s {
        simd.add_f32s(sums, simd.mul_f32s(a, b))
    }

    #[inline(always)]
    fn widen(values: &[f32]) -> &[S::f32s] {
        S::as_simd_f32s(values).0
    }

    #[inline(always)]
    fn widen_mut(values: &mut [f32]) -> &mut [S::f32s] {
        S::as_mut_simd_f32s(values).0
    }
}

impl<S: Simd> Number<S> for f64 {
    type Wide = S::f64s;

    #[inline(always)]
    fn splat(self, simd: S) -> S::f64s {
        simd.splat_f64s(self)
    }

    #[inline(always)]
    fn add_product(simd: S, sums: S::f64s, a: S::f64s, b: S::f64s) -> S::f64s {
        simd.add_f64s(sums, simd.mul_f64s(a, b))
    }

    #[inline(always)]
    fn widen(values: &[f64]) -> &[S::f64s] {
        S::as_simd_f64s(values).0
    }

    #[inline(always)]
    fn widen_mut(values: &mut [f64]) -> &mut [S::f64s] {
        S::as_mut_simd_f64s(values).0
    }
}

/// Registers of sums.
const REGISTERS: usize = 4;

/// Correlates a line with a length that is a multiple of `LANES`; `values` begins as far
/// before the line as the taps reach.
#[inline(always)]
pub fn correlate<S: Simd, T: Number<S>, const LANES: usize>(
    simd: S,
    taps: &[T],
    values: &[T],
    line: &mut [T],
) {
    for (block, sums) in line.chunks_exact_mut(LANES).enumerate() {
        let start = block * LANES;
        let values = taps
            .iter()
            .zip(start..)
            .map(|(tap, at)| (*tap, &values[at..][..LANES]));
        add_products::<S, T>(simd, values, sums);
    }
}

/// Correlates `LANES` columns; `starts` are where their rows begin in `values`, one per tap.
#[inline(always)]
pub fn correlate_down<S: Simd, T: Number<S>, const LANES: usize>(
    simd: S,
    taps: &[T],
    values: &[T],
    starts: &[usize],
) -> [T; LANES] {
    let mut sums = [T::default(); LANES];
    let values = (taps.iter().zip(starts)).map(|(tap, at)| (*tap, &values[*at..][..LANES]));
    add_products::<S, T>(simd, values, &mut sums);
    sums
}

/// Sums lines of as many values as there are sums, each times its tap.
#[inline(always)]
fn add_products<'a, S: Simd, T: Number<S> + 'a>(
    simd: S,
    lines: impl Iterator<Item = (T, &'a [T])> + Clone,
    sums: &mut [T],
) {
    let zero = T::default().splat(simd);
    for (group, sums) in T::widen_mut(sums).chunks_exact_mut(REGISTERS).enumerate() {
        let (mut first, mut second, mut third, mut fourth) = (zero, zero, zero, zero);
        for (tap, values) in lines.clone() {
            let tap = tap.splat(simd);
            let values = &T::widen(values)[group * REGISTERS..][..REGISTERS];
            first = T::add_product(simd, first, tap, values[0]);
            second = T::add_product(simd, second, tap, values[1]);
            third = T::add_product(simd, third, tap, values[2]);
            fourth = T::add_product(simd, fourth, tap, values[3]);
        }
        sums.copy_from_slice(&[first, second, third, fourth]);
    }
}
