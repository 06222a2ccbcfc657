//! Powers of numbers that are not negative, a line at a time.

/// Raises `x`, not negative and finite, to `y` in [0, 1]. The result is rounded from 9 good digits,
/// so that it nearly always equals the system library's. There is no branch, so that loops over it
/// compile to wide instructions.
#[inline(always)]
pub fn power(x: f32, y: f32) -> f32 {
    let product = f64::from(y) * log2(f64::from(x));
    let raised = exp2(product.max(LEAST_EXPONENT)) as f32;
    if (x > 0.0) | (y == 0.0) { raised } else { 0.0 }
}

/// Exponents below give 0 in 32 bits.
const LEAST_EXPONENT: f64 = -1000.0;

/// Bits of the fraction of a 64-bit number.
const FRACTION: u32 = 52;
/// Bits of 1.
const ONE: u64 = 1023 << FRACTION;
/// Bits of the root of a half: mantissas are taken from there to the root of two.
const ROOT_OF_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
/// 2^52: its last bit counts ones.
const WHOLE: f64 = (1_u64 << FRACTION) as f64;

/// Computes the binary logarithm of a positive number.
#[inline(always)]
fn log2(x: f64) -> f64 {
    let shifted = x.to_bits().wrapping_add(ONE - ROOT_OF_HALF);
    let exponent = shifted >> FRACTION;
    let mantissa = x
        .to_bits()
        .wrapping_sub((exponent << FRACTION).wrapping_sub(ONE));
    // No instruction converts whole numbers of 64 bits, so they go into the fraction of 2^52.
    let exponent = f64::from_bits(exponent | WHOLE.to_bits()) - (WHOLE + 1023.0);
    let mantissa = f64::from_bits(mantissa);
    // log2 m = 2 / ln 2 * atanh s, |s| < 0.172: the first term that is left out is below 1e-9.
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let square = s * s;
    let series = 1.0
        + square
            * (1.0 / 3.0
                + square
                    * (1.0 / 5.0
                        + square * (1.0 / 7.0 + square * (1.0 / 9.0 + square * (1.0 / 11.0)))));
    exponent + std::f64::consts::LOG2_E * 2.0 * s * series
}

/// Computes 2^x for x in [-1000, 1000].
#[inline(always)]
fn exp2(x: f64) -> f64 {
    /// Added, it leaves the nearest whole number in the last bits.
    const ROUND: f64 = 1.5 * WHOLE;
    let rounded = x + ROUND;
    let rest = (x - (rounded - ROUND)) * std::f64::consts::LN_2;
    let scale = f64::from_bits((rounded.to_bits() << FRACTION).wrapping_add(ONE));
    // Taylor's series of e^rest, |rest| < 0.347: the first term that is left out is below 1e-9.
    let series = 1.0
        + rest
            * (1.0
                + rest
                    * (1.0 / 2.0
                        + rest
                            * (1.0 / 6.0
                                + rest
                                    * (1.0 / 24.0
                                        + rest
                                            * (1.0 / 120.0
                                                + rest
                                                    * (1.0 / 720.0
                                                        + rest
                                                            * (1.0 / 5040.0
                                                                + rest / 40_320.0)))))));
    scale * series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_is_what_64_bits_round_to() {
        for step in 0..20_000_u32 {
            let x = f32::from_bits(0x0080_0000 + step * 53_687);
            for y in [1.0 / 3.0, 0.5, 0.7, 0.03, 1.0_f32] {
                let expected = f64::from(x).powf(f64::from(y));
                let value = f64::from(power(x, y));
                // Half a step of 32 bits, and 1e-10 for the series.
                assert!(
                    (value - expected).abs() <= (0.5 * f64::from(f32::EPSILON) + 1e-9) * expected,
                    "{x} to {y}: {value}, expected {expected}"
                );
            }
        }
    }

    #[test]
    fn zero_stays_zero_but_to_the_power_of_zero() {
        assert_eq!(power(0.0, 0.01), 0.0);
        assert_eq!(power(0.0, 0.0), 1.0);
        assert_eq!(power(0.5, 0.0), 1.0);
    }
}
