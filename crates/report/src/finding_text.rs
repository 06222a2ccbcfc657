//! A finding in words: its status, its score and the way out.

use suite::{Finding, Level, MOST_SAMPLES, Outcome, number};

/// `BROKEN flip_moving 0.0921 (95 % CI 0.0893 to 0.0950); limit 0.0500, floor 0.0021`
pub fn finding_line(finding: &Finding) -> String {
    format!("{} {}", finding_status(finding), finding_score(finding))
}

/// What became of the bound: `BROKEN`.
pub fn finding_status(finding: &Finding) -> &'static str {
    match (finding.outcome, finding.level) {
        (Outcome::Broken, Level::Required) => "BROKEN",
        (Outcome::Broken, Level::Report) => "broken (report)",
        (Outcome::Inconclusive, Level::Required) => "INCONCLUSIVE",
        (Outcome::Inconclusive, Level::Report) => "inconclusive (report)",
        (Outcome::TooNoisy, _) => "TOO STRICT",
        (Outcome::Kept, _) => "kept",
        (Outcome::NotApplicable, _) => "not applicable",
    }
}

/// The score beside its limit: `flip_moving 0.0921 (95 % CI 0.0893 to 0.0950); limit 0.0500, floor 0.0021`.
pub fn finding_score(finding: &Finding) -> String {
    let mut text = finding.metric.clone();
    if let Some(value) = finding.value {
        text += &format!(" {}", finding.with_unit(value));
    }
    if let Some(interval) = &finding.interval {
        let [low, high] = [interval.low, interval.high].map(number);
        text += &format!(" (95 % CI {low} to {high})");
    }
    text += &format!("; limit {}", number(finding.limit));
    if let Some(floor) = finding.floor {
        text += &format!(", floor {}", number(floor));
    }
    text
}

/// What to do about a score that was not judged.
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
