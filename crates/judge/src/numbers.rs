//! Numbers as people write them, and rounded to their digits.

/// Formats a number with four significant digits, as people write it.
pub fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let size = value.abs().log10().floor();
    if (-4.0..6.0).contains(&size) {
        format!("{value:.*}", (3.0 - size).max(0.0) as usize)
    } else {
        format!("{value:.3e}")
    }
}

/// Rounds to significant digits.
pub fn round_to_digits(value: f64, digits: usize) -> f64 {
    let text = format!("{value:.*e}", digits - 1);
    text.parse().expect("a number as text is a number")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_digits_that_count() {
        for (value, text) in [
            (0.0, "0"),
            (0.05, "0.05000"),
            (-12.3456, "-12.35"),
            (123456.0, "123456"),
            (0.000_123_456, "0.0001235"),
            (1.5e-7, "1.500e-7"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn a_rounded_number_keeps_its_digits() {
        for (value, rounded) in [
            (0.123_456_789, 0.123_457),
            (-1_234.567_89, -1_234.57),
            (0.0, 0.0),
        ] {
            assert_eq!(round_to_digits(value, 6), rounded);
        }
    }
}
