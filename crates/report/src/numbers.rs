//! Numbers as text.

use filters::Value;

/// Formats a change with three digits: `+0.0123`.
pub fn signed(value: f64) -> String {
    match value {
        // Rounding of no change.
        value if value.abs() < 1e-9 => "0".to_owned(),
        value if value.abs() < 1e-4 => format!("{value:+.0e}"),
        value => {
            let digits = (2.0 - value.abs().log10().floor()).clamp(0.0, 4.0) as usize;
            format!("{value:+.digits$}")
        }
    }
}

/// Formats a mean log of errors as a change of the error: `-18.6 %`.
pub fn percent(log: f64) -> String {
    format!("{:+.1} %", 100.0 * log.exp_m1())
}

/// Formats the value of a parameter; nobody sets more than six digits.
pub fn value_text(value: &Value) -> String {
    match value {
        Value::Real(value) => {
            let rounded: f64 = format!("{value:.5e}").parse().expect("it was a number");
            rounded.to_string()
        }
        Value::Integer(_) | Value::Choice(_) => value.to_string(),
    }
}

/// Formats `1 scene`, `2 scenes`.
pub fn counted(count: usize, noun: &str) -> String {
    match count {
        1 => format!("1 {noun}"),
        count => format!("{count} {noun}s"),
    }
}

/// Formats a number with three significant digits.
pub fn three_digits(value: f64) -> String {
    let digits = (2.0 - value.abs().log10().floor()).clamp(0.0, 9.0) as usize;
    match value {
        0.0 => "0".to_owned(),
        value => format!("{value:.digits$}"),
    }
}

/// Averages numbers; none without any.
pub fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (count, sum) = values.fold((0, 0.0), |(count, sum), value| (count + 1, sum + value));
    (count > 0).then(|| sum / f64::from(count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_have_a_sign_and_three_digits() {
        for (value, expected) in [
            (0.0, "0"),
            (-3e-14, "0"),
            (0.01234, "+0.0123"),
            (-0.000_12, "-0.0001"),
            (0.000_012, "+1e-5"),
            (-3.456, "-3.46"),
            (123.4, "+123"),
        ] {
            assert_eq!(signed(value), expected);
        }
    }

    #[test]
    fn values_have_six_digits_and_times_three() {
        let words = [
            0.049_999_999_999_999_996,
            1_666.666_666_666_666_5,
            1.0,
            1e-6,
        ];
        let words = words.map(|value| value_text(&Value::Real(value)));
        assert_eq!(words, ["0.05", "1666.67", "1", "0.000001"]);
        let words = [12.345, 0.012_345, 1234.5, 0.0].map(three_digits);
        assert_eq!(words, ["12.3", "0.0123", "1234", "0"]);
    }
}
