//! One bounded score, with everything there is to say about it.

use std::path::PathBuf;

use metrics::{Interval, Measured, Metric};
use serde::{Deserialize, Serialize};

use super::Judged;
use super::decoys::Resemblance;
use super::outcome::{Outcome, limit_as_badness};
use super::worst::Worst;
use crate::judge::bounds::Level;
use crate::{Case, Run};

/// A score and its bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// How the score stands to its bound.
    #[serde(rename = "kind")]
    pub outcome: Outcome,
    /// What it means to break the bound.
    pub level: Level,
    /// Scene, with its variant.
    pub scene: String,
    /// `filter:preset`, and the form of its input where that is not the usual one.
    pub filter: String,
    /// Name of the metric.
    pub metric: String,
    /// Its unit; empty for a pure number.
    pub unit: String,
    /// The score; none where the metric does not apply.
    pub value: Option<f64>,
    /// 95 % CI of the score against a truth without noise; none where that cannot be told.
    pub interval: Option<Interval>,
    /// The limit.
    pub limit: f64,
    /// Noise floor of the score; none where the metric does not apply.
    pub floor: Option<f64>,
    /// The strictest limit that the floor can carry.
    pub strictest: Option<f64>,
    /// Reason for the limit.
    pub why: String,
    /// File and line of the bound.
    pub place: String,
    /// Reason why the metric does not apply.
    pub reason: Option<String>,
    /// Samples per pixel that would settle an inconclusive score.
    pub settled_by: Option<u64>,
    /// Place where the error is largest; none where nobody asked for evidence.
    pub worst: Option<Worst>,
    /// The wrong blur that the picture is most like; none where it is like none, or nobody asked for evidence.
    pub resembles: Option<Resemblance>,
    /// Folder of the case's pictures, relative to `run.json`.
    pub pictures: PathBuf,
}

/// Samples per pixel, 8 times a power of two, that would part the interval from the limit if its middle stayed: widths fall
/// as the root of the samples.
fn settled_by(run: &Run, metric: Metric, interval: &Interval, limit: f64) -> u64 {
    let middle = metric.ideal().badness((interval.low + interval.high) / 2.0);
    let apart = (middle - limit_as_badness(metric.ideal(), limit)).abs();
    let half_width = (interval.high - interval.low) / 2.0;
    let more = (half_width / apart).powi(2);
    let mut samples = u64::from(run.samples_per_pixel);
    while (samples as f64) < more * f64::from(run.samples_per_pixel) && samples < MOST_SAMPLES {
        samples *= 2;
    }
    samples
}

/// Samples per pixel that a truth may have at most: a score that needs as many or more stays undecided.
pub const MOST_SAMPLES: u64 = tracer::MOST_SAMPLES as u64;

impl Finding {
    /// What `judged` says of a case of a run, without evidence.
    pub(super) fn new(run: &Run, case: &Case, judged: Judged) -> Self {
        let Judged {
            metric: name,
            bound,
            measured,
            outcome,
        } = judged;
        let metric: Metric = name.parse().expect("a judged score is a metric's");
        let (score, reason) = match measured {
            Measured::Score(score) => (Some(score), None),
            Measured::NotApplicable { reason } => (None, Some(reason)),
        };
        let interval = case.intervals.get(&name).copied();
        Self {
            outcome,
            level: bound.level,
            scene: case.scene.clone(),
            filter: case.name(),
            metric: name,
            unit: metric.unit().to_owned(),
            value: score.map(|score| score.value),
            interval,
            limit: bound.limit,
            floor: score.map(|score| score.floor),
            strictest: score.map(|score| metric.strictest_bound(score.floor)),
            why: bound.why,
            place: bound.place,
            reason,
            settled_by: match (outcome, &interval) {
                (Outcome::Inconclusive, Some(interval)) => {
                    Some(settled_by(run, metric, interval, bound.limit))
                }
                _ => None,
            },
            worst: None,
            resembles: None,
            pictures: case.folder.clone(),
        }
    }

    /// True for a finding about this case.
    pub fn is_of(&self, case: &Case) -> bool {
        self.scene == case.scene && self.filter == case.name()
    }

    /// The score with its unit: `0.0921`, `1.31 px`.
    pub fn shown(&self, value: f64) -> String {
        match self.unit.as_str() {
            "" => number(value),
            unit => format!("{} {unit}", number(value)),
        }
    }
}

/// A number with four significant digits, as people write it.
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
}
