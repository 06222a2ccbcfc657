//! Numbers that an engine stores as half floats.

use half::f16;

/// Smallest part of the numbers that are between halves if they were stored as floats.
const LEAST_BETWEEN: f64 = 1e-3;

/// Returns whether numbers came from half floats, in the file or in a texture of the engine that
/// was read back as floats. Numbers that are all alike may be either.
pub fn are_halves(numbers: impl Iterator<Item = f32>) -> bool {
    let (mut all, mut between, mut fractional) = (0_u64, 0_u64, 0_u64);
    for number in numbers {
        all += 1;
        between += u64::from(f16::from_f32(number).to_f32() != number);
        // Small whole numbers are the same in either form.
        fractional += u64::from(number.fract() != 0.0);
    }
    let part = |count: u64| count as f64 / all.max(1) as f64;
    part(between) < LEAST_BETWEEN && part(fractional) > LEAST_BETWEEN
}

/// Returns the largest rounding error of a number stored as a half float.
pub fn rounding_of(number: f32) -> f32 {
    number.abs() / 2048.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_are_told_from_floats() {
        let floats = || (1..500).map(|number| number as f32 / 7.0);
        let halves = || floats().map(|number| f16::from_f32(number).to_f32());
        assert!(!are_halves(floats()));
        assert!(are_halves(halves()));
        assert!(!are_halves((0..500).map(|number| number as f32)), "whole");
        let worst = (floats().zip(halves()))
            .map(|(float, half)| (float - half).abs() / rounding_of(float))
            .fold(0.0, f32::max);
        assert!(worst <= 1.0, "{worst}");
    }
}
