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
        (Outcome::TooNoisy, _) => "TOO STRICT",
        (Outcome::Kept, _) => "kept",
        (Outcome::NotApplicable, _) => "not applicable",
    }
}

/// Writes the score beside its limit: `flip_moving 0.0921 (95 % CI 0.0893 to 0.0950); limit 0.0500, floor 0.0021`.
pub fn finding_score(finding: &Finding) -> String {
    let mut text = finding.metric.clone();
    match (finding.value, &finding.interval) {
        (Some(value), Some(interval)) => {
            let Interval { low, high, .. } = *interval;
            // The truth's noise is taken out of the middle, and is in the score itself.
            let estimate = finding.with_unit((low + high) / 2.0);
            text += &format!(" {estimate} (95 % CI {} to {}", number(low), number(high));
            text += &match (low..=high).contains(&value) {
                true => ")".to_owned(),
                false => format!("; with noise {})", number(value)),
            };
        }
        (Some(value), None) => text += &format!(" {}", finding.with_unit(value)),
        (None, _) => {}
    }
    text += &format!("; limit {}", number(finding.limit));
    if let Some(floor) = finding.floor {
        text += &format!(", floor {}", number(floor));
    }
    text
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
