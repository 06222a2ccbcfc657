//! A finding in words: its status, its score and the remedy.

use judge::{Finding, Length, Level, MAX_SAMPLES, Outcome, number};
use maud::{Markup, Render, html};
use metrics::{Ideal, Interval};

/// Status of a score against its bound, shown by colour, sign and word, never by colour alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Status {
    /// Class in the style sheet, and word for a reader.
    pub word: &'static str,
    /// Sign before the number.
    sign: &'static str,
}

impl Status {
    /// Returns the status of an outcome; none if the metric does not apply.
    pub fn of(outcome: Outcome) -> Option<Self> {
        let (word, sign) = match outcome {
            Outcome::Kept => ("met", "✓"),
            Outcome::Broken => ("broken", "✗"),
            Outcome::Inconclusive => ("inconclusive", "?"),
            Outcome::TooNoisy => ("undecided", "~"),
            Outcome::NotApplicable | Outcome::NotJudged => return None,
        };
        Some(Self { word, sign })
    }

    /// Returns the class of a score with a required bound; none for targets.
    pub fn required_class(finding: &Finding) -> Option<&'static str> {
        let required = Self::of(finding.outcome).filter(|_| finding.level == Level::Required);
        required.map(|status| status.word)
    }
}

/// The sign.
impl Render for Status {
    fn render(&self) -> Markup {
        html! { span.sign aria-hidden="true" { (self.sign) } }
    }
}

/// Numbers of findings of one level, by outcome.
#[derive(Default)]
pub struct Tally {
    /// All of the level.
    pub all: usize,
    /// Limits that are met.
    pub met: usize,
    /// Limits that are broken.
    pub broken: usize,
    /// Scores that are too noisy to decide.
    pub undecided: usize,
}

impl Tally {
    /// Counts the findings of a level.
    pub fn of<'a>(findings: impl IntoIterator<Item = &'a &'a Finding>, level: Level) -> Self {
        let mut tally = Self::default();
        for finding in findings
            .into_iter()
            .filter(|finding| finding.level == level)
        {
            tally.all += 1;
            match finding.outcome {
                Outcome::Kept => tally.met += 1,
                Outcome::Broken => tally.broken += 1,
                Outcome::Inconclusive | Outcome::TooNoisy => tally.undecided += 1,
                Outcome::NotApplicable | Outcome::NotJudged => {}
            }
        }
        tally
    }
}

/// Formats a finding in one line: `BROKEN flip_moving 0.0921 (95 % CI 0.0893 to 0.0950); limit
/// 0.0500, floor 0.0021`
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
        (Outcome::TooNoisy, Level::Required) => "LIMIT WITHIN NOISE",
        (Outcome::TooNoisy, Level::Report) => "target within noise",
        (Outcome::Kept, _) => "met",
        (Outcome::NotApplicable, _) => "not applicable",
        (Outcome::NotJudged, _) => "not judged",
    }
}

/// Formats the score with its limit: `flip_moving 0.0921 (95 % CI 0.0893 to 0.0950); limit 0.0500,
/// floor 0.0021`. For a limit on the distance from an ideal, formats the distance: `extent 0.0385
/// from 1 (95 % CI 0.0354 to 0.0416); limit 0.0400`.
pub fn finding_score(finding: &Finding) -> String {
    let ideal = finding.metric.ideal();
    let limited = |value: f64| match ideal {
        Ideal::Target(target) => {
            format!("{} from {target}", finding.with_unit(ideal.badness(value)))
        }
        _ => finding.with_unit(value),
    };
    let mut text = finding.metric.name();
    text.extend(length_text(finding).map(|length| format!(" over {length}")));
    if let Some(value) = finding.value {
        let estimate = finding.interval.map_or(value, |interval| interval.center);
        text += &format!(" {}", limited(estimate));
    }
    if let Some(interval) = &finding.interval {
        let (low, high) = match ideal {
            Ideal::Target(_) => ideal.badness_within(interval),
            _ => (interval.low, interval.high),
        };
        text += &format!(" (95 % CI {} to {})", number(low), number(high));
        if let Some(measured) = finding.value.filter(|value| !interval.holds(*value)) {
            text += &format!(", measured {}", limited(measured));
        }
    }
    text += &format!("; limit {}", number(finding.limit));
    if let Some(floor) = finding.floor {
        text += &format!(", floor {}", number(floor));
    }
    text
}

/// Formats the limit for display next to its score: `0.0500`, or `0.0400 from 1` for a limit on the
/// distance from an ideal.
pub fn limit_text(finding: &Finding) -> String {
    let limit = number(finding.limit);
    match finding.metric.ideal() {
        Ideal::Target(target) => format!("{limit} from {target}"),
        _ => limit,
    }
}

/// Formats the length of the limit's sequence, `4 frames` or `4 frames at 60 per second`; none for
/// a score of a single frame.
pub fn length_text(finding: &Finding) -> Option<String> {
    let length = Length {
        frames: finding.frames?,
        per_second: finding.fps,
    };
    Some(length.text())
}

/// Formats the frame with a sequence's worst score: `worst in frame 2`.
pub fn worst_frame_text(finding: &Finding) -> Option<String> {
    Some(format!("worst in frame {}", finding.worst_frame?))
}

/// Formats `95 % CI 0.05198 to 0.05332, measured 0.05364`; the measured value only if the truth's
/// noise moved it out of the interval.
pub fn interval_text(interval: &Interval, measured: f64) -> String {
    let [low, high] = [interval.low, interval.high].map(number);
    let raw = if interval.holds(measured) {
        String::new()
    } else {
        format!(", measured {}", number(measured))
    };
    format!("95 % CI {low} to {high}{raw}")
}

/// Suggests what to do about a score that was not judged.
pub fn way_out(finding: &Finding) -> Option<String> {
    match finding.outcome {
        Outcome::TooNoisy => Some(format!(
            "the noise floor of {} allows {} at the strictest; raise the limit, or {}",
            number(finding.floor?),
            number(finding.strictest?),
            match finding.subframes {
                None => "render more samples per pixel".to_owned(),
                Some(count) => format!("capture more sub-frames than {count}"),
            }
        )),
        Outcome::Inconclusive => Some(match finding.settled_by {
            None => "too noisy for a confidence interval; render more samples per pixel".to_owned(),
            Some(MAX_SAMPLES..) => {
                "too close to the limit for any number of samples; move the limit".to_owned()
            }
            Some(samples) => format!("{samples} samples per pixel would settle it"),
        }),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_outside_of_its_interval_is_written_after_it() {
        let interval = Interval {
            low: 0.051_98,
            high: 0.053_32,
            center: 0.052_65,
            standard_error: 0.0003,
        };
        assert!(interval.holds(interval.center));
        let text = |measured| interval_text(&interval, measured);
        assert_eq!(text(0.053), "95 % CI 0.05198 to 0.05332");
        assert_eq!(
            text(0.053_64),
            "95 % CI 0.05198 to 0.05332, measured 0.05364"
        );
    }

    #[test]
    fn a_distance_is_printed_with_a_limit_on_a_distance() {
        let finding: Finding = serde_json::from_value(serde_json::json!({
            "kind": "kept", "level": "required", "scene": "fan", "filter": "kino:default",
            "metric": "extent", "unit": "", "value": 0.9615,
            "interval": {"low": 0.9584, "high": 0.9646, "center": 0.9615, "standard_error": 0.001},
            "limit": 0.04, "floor": null, "strictest": null, "why": "", "place": "", "reason": null,
            "settled_by": null, "worst": null, "resembles": null, "pictures": "",
        }))
        .unwrap();
        assert_eq!(
            finding_score(&finding),
            "extent 0.03850 from 1 (95 % CI 0.03540 to 0.04160); limit 0.04000"
        );
        assert_eq!(limit_text(&finding), "0.04000 from 1");
    }
}
