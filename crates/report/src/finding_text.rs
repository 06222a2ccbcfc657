//! A finding in words: its status, its score and the way out.

use metrics::Interval;
use suite::{Finding, Level, MOST_SAMPLES, Outcome, number};

/// Status of a score against its bound, told by colour, sign and word: never by the colour alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Status {
    /// Class in the style sheet, and word for a reader.
    pub word: &'static str,
    /// Sign before the number.
    pub sign: &'static str,
}

impl Status {
    /// Names the status of an outcome; none where the metric does not apply.
    pub fn of(outcome: Outcome) -> Option<Self> {
        let (word, sign) = match outcome {
            Outcome::Kept => ("kept", "✓"),
            Outcome::Broken => ("broken", "✗"),
            Outcome::Inconclusive => ("inconclusive", "?"),
            Outcome::TooNoisy => ("undecided", "~"),
            Outcome::NotApplicable => return None,
        };
        Some(Self { word, sign })
    }
}

/// Writes a finding in one line: `BROKEN flip_moving 0.0921 (95 % CI 0.0893 to 0.0950); limit 0.0500, floor 0.0021`
pub fn finding_line(finding: &Finding) -> String {
    format!("{} {}", finding_status(finding), finding_score(finding))
}

/// Names the outcome: `BROKEN`.
pub fn finding_status(finding: &Finding) -> &'static str {
    match (finding.outcome, finding.level) {
        (Outcome::Broken, Level::Required) => "BROKEN",
        (Outcome::Broken, Level::Report) => "target missed",
        (Outcome::Inconclusive, Level::Required) => "UNDECIDED",
        (Outcome::Inconclusive, Level::Report) => "target undecided",
        (Outcome::TooNoisy, _) => "LIMIT WITHIN NOISE",
        (Outcome::Kept, _) => "kept",
        (Outcome::NotApplicable, _) => "not applicable",
    }
}

/// Writes the score beside its limit: `flip_moving 0.0921 (95 % CI 0.0893 to 0.0950); limit 0.0500, floor 0.0021`.
pub fn finding_score(finding: &Finding) -> String {
    let mut text = finding.metric.clone();
    if let Some(value) = finding.value {
        let without_noise = estimate(value, finding.interval.as_ref());
        text += &format!(" {}", finding.with_unit(without_noise));
    }
    if let Some(interval) = &finding.interval {
        let [low, high] = [interval.low, interval.high].map(number);
        text += &format!(" (95 % CI {low} to {high})");
        if let Some(measured) = finding.value.filter(|value| !holds(interval, *value)) {
            text += &format!(", measured {}", finding.with_unit(measured));
        }
    }
    text += &format!("; limit {}", number(finding.limit));
    if let Some(floor) = finding.floor {
        text += &format!(", floor {}", number(floor));
    }
    text
}

/// Estimates the score against a truth without noise: the middle of its interval, or the measured value without one.
pub fn estimate(value: f64, interval: Option<&Interval>) -> f64 {
    interval.map_or(value, |own| f64::midpoint(own.low, own.high))
}

/// Tells whether an interval holds the measured value. The truth's noise moves a score, and the interval is about a truth without.
pub fn holds(interval: &Interval, value: f64) -> bool {
    (interval.low..=interval.high).contains(&value)
}

/// Tells what to do about a score that was not judged.
pub fn way_out(finding: &Finding) -> Option<String> {
    match finding.outcome {
        Outcome::TooNoisy => Some(format!(
            "the noise floor of {} allows {} at the strictest; raise the limit, or --samples-per-pixel",
            number(finding.floor?),
            number(finding.strictest?)
        )),
        Outcome::Inconclusive => Some(match finding.settled_by {
            None => {
                "parts of the truth cannot tell this score; raise --samples-per-pixel".to_owned()
            }
            Some(MOST_SAMPLES..) => {
                "too close to the limit for any number of samples; move the limit".to_owned()
            }
            Some(samples) => format!("--samples-per-pixel {samples} would settle it"),
        }),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_estimate_lies_in_its_interval() {
        let interval = Interval {
            low: 0.051_98,
            high: 0.053_32,
            standard_error: 0.0003,
        };
        let without_noise = estimate(0.053_64, Some(&interval));
        assert!(holds(&interval, without_noise) && !holds(&interval, 0.053_64));
        assert_eq!(estimate(0.053_64, None), 0.053_64);
    }
}
