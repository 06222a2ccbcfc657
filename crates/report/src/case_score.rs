//! Score of a case as pages show it: estimated against a truth without noise, with its interval.

use metrics::Interval;
use suite::{Case, Headline, number};

use crate::finding_text::{estimate, holds};

/// Finds the interval of a case's score; none where the run has no intervals.
pub fn interval_of(case: &Case, headline: Headline) -> Option<&Interval> {
    case.intervals.get(&headline.metric(&case.scores)?.name())
}

/// Estimates a case's score against a truth without noise; none where the score does not apply.
pub fn estimate_of(case: &Case, headline: Headline) -> Option<f64> {
    let value = headline.measured(case).value()?;
    Some(estimate(value, interval_of(case, headline)))
}

/// Writes the estimate as a cell has it: `0.063`, `4.80>`, `<1`, `n/a`.
pub fn estimate_text(case: &Case, headline: Headline) -> String {
    let measured = headline.text(case);
    match (estimate_of(case, headline), interval_of(case, headline)) {
        // Counts of sub-frames have ends that no estimate has.
        (Some(value), Some(_)) if headline != Headline::SUBFRAMES => {
            let side =
                measured.trim_start_matches(|c: char| c.is_ascii_digit() || "-.".contains(c));
            headline.number(value) + side
        }
        _ => measured,
    }
}

/// Writes `95 % CI 0.05198 to 0.05332, measured 0.05364`; the measured value only where the truth's noise moved it out of the
/// interval.
pub fn interval_text(interval: &Interval, measured: f64) -> String {
    let [low, high] = [interval.low, interval.high].map(number);
    let raw = match holds(interval, measured) {
        true => String::new(),
        false => format!(", measured {}", number(measured)),
    };
    format!("95 % CI {low} to {high}{raw}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_outside_of_its_interval_stands_beside_it() {
        let interval = Interval {
            low: 0.051_98,
            high: 0.053_32,
            standard_error: 0.0003,
        };
        let text = |measured| interval_text(&interval, measured);
        assert_eq!(text(0.053), "95 % CI 0.05198 to 0.05332");
        assert_eq!(
            text(0.053_64),
            "95 % CI 0.05198 to 0.05332, measured 0.05364"
        );
    }
}
