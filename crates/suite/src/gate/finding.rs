//! One bounded score, with everything there is to say about it.

use std::path::PathBuf;
use std::str::FromStr;

use metrics::{Interval, Measured, Metric};
use serde::Serialize;

use super::Decision;
use crate::bounds::Level;
use crate::decoys::Resemblance;
use crate::verdict::limit_as_badness;
use crate::worst::Worst;
use crate::{Case, Outcome, Run, Verdict};

/// A score and its bound.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// How it turned out.
    pub kind: Kind,
    /// Whether it counts.
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
    /// Where the score against a truth without noise lies, with a confidence of 95 %; none where that cannot be told.
    pub interval: Option<Interval>,
    /// What is allowed.
    pub limit: f64,
    /// What the truth's noise makes of the score; none where the metric does not apply.
    pub floor: Option<f64>,
    /// The strictest limit that the floor can carry.
    pub strictest: Option<f64>,
    /// Why the limit is what it is.
    pub why: String,
    /// File and line of the bound.
    pub place: String,
    /// Why the metric does not apply.
    pub reason: Option<String>,
    /// Samples per pixel that would settle an inconclusive score.
    pub settled_by: Option<u64>,
    /// Where the error is largest.
    pub worst: Option<Worst>,
    /// The wrong blur that the picture is most like.
    pub resembles: Option<Resemblance>,
    /// Folder of the case's pictures, relative to `run.json`.
    pub pictures: PathBuf,
}

/// How a score stands to its bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// It keeps it.
    Kept,
    /// It breaks it.
    Broken,
    /// Its interval lies on both sides.
    Inconclusive,
    /// The bound is stricter than three noise floors.
    TooNoisy,
    /// The metric does not apply.
    NotApplicable,
}

/// One finding per verdict of a run.
pub fn findings(run: &Run) -> Vec<Finding> {
    let of = |case| move |verdict| finding(run, case, verdict);
    (run.cases.iter())
        .flat_map(|case| case.verdicts.iter().map(of(case)))
        .collect()
}

fn finding(run: &Run, case: &Case, verdict: &Verdict) -> Finding {
    let metric = Metric::from_str(&verdict.metric).expect("a run's verdicts are about metrics");
    let score = match case.scores.get(metric) {
        Measured::Score(score) => Some(score),
        Measured::NotApplicable { .. } => None,
    };
    let interval = case.intervals.get(&verdict.metric).copied();
    let (kind, reason) = match &verdict.outcome {
        Outcome::Kept { .. } => (Kind::Kept, None),
        Outcome::Broken { .. } => (Kind::Broken, None),
        Outcome::Inconclusive { .. } => (Kind::Inconclusive, None),
        Outcome::TooNoisy { .. } => (Kind::TooNoisy, None),
        Outcome::NotApplicable { reason } => (Kind::NotApplicable, Some(reason.clone())),
    };
    Finding {
        kind,
        level: verdict.level,
        scene: case.scene.clone(),
        filter: case.name(),
        metric: verdict.metric.clone(),
        unit: metric.unit().to_owned(),
        value: score.map(|score| score.value),
        interval,
        limit: verdict.limit,
        floor: score.map(|score| score.floor),
        strictest: score.map(|score| metric.strictest_bound(score.floor)),
        why: verdict.why.clone(),
        place: verdict.place.clone(),
        reason,
        settled_by: match (kind, &interval) {
            (Kind::Inconclusive, Some(interval)) => {
                Some(settled_by(run, metric, interval, verdict.limit))
            }
            _ => None,
        },
        worst: verdict.worst.clone(),
        resembles: case.resembles.clone(),
        pictures: case.folder.clone(),
    }
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

/// Nobody renders more: a score so close to its limit stays undecided.
pub const MOST_SAMPLES: u64 = 1 << 24;

impl Finding {
    /// What it alone comes to.
    pub fn decision(&self) -> Decision {
        match (self.kind, self.level) {
            (Kind::TooNoisy, _) => Decision::Misconfigured,
            (Kind::Broken, Level::Required) => Decision::Broken,
            (Kind::Inconclusive, Level::Required) => Decision::Inconclusive,
            _ => Decision::Pass,
        }
    }

    /// Whether it says something about the case.
    pub fn applies_to(&self, case: &Case) -> bool {
        self.kind != Kind::NotApplicable && self.scene == case.scene && self.filter == case.name()
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
