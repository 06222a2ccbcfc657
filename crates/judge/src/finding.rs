//! Finding about one bounded score.

use std::path::PathBuf;

use measure::{Case, Run, Sequence};
use metrics::{Interval, Measured, Metric};
use scene::SceneId;
use serde::{Deserialize, Serialize};

use crate::bounds::Level;
use crate::decoys::Resemblance;
use crate::judged_score::JudgedScore;
use crate::numbers::number;
use crate::outcome::{Decision, Outcome, limit_as_badness};
use crate::worst::Worst;

/// A score, its bound, and the outcome.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Outcome of the bound.
    #[serde(rename = "kind")]
    pub outcome: Outcome,
    /// Consequence of breaking the bound.
    pub level: Level,
    /// Scene.
    pub scene: SceneId,
    /// `filter:preset`, and the form of its input if unusual.
    pub filter: String,
    /// Metric of the score.
    pub metric: Metric,
    /// Its unit; empty for a pure number.
    pub unit: String,
    /// Score; none if the metric does not apply.
    pub value: Option<f64>,
    /// 95 % confidence interval of the score against a truth without noise; none if unknown.
    pub interval: Option<Interval>,
    /// Limit of the bound.
    pub limit: f64,
    /// Noise floor of the score; none if the metric does not apply.
    pub floor: Option<f64>,
    /// Strictest limit that the floor allows.
    pub strictest: Option<f64>,
    /// Frames of the sequence that the limit is for; none for a score of a single frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames: Option<u32>,
    /// Frames per second that the limit is for; none for a score that does not depend on them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fps: Option<f64>,
    /// Frame of the sequence with the worst score, from 0; none for a score to which single frames
    /// contribute nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst_frame: Option<u32>,
    /// Reason for the limit.
    pub why: String,
    /// File and line of the bound.
    pub place: String,
    /// Reason why the metric does not apply.
    pub reason: Option<String>,
    /// Samples per pixel that would settle an inconclusive score.
    pub settled_by: Option<u64>,
    /// Sub-frames of an engine's truth; none if the truth was rendered.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub subframes: Option<u32>,
    /// Place of the largest error; none without evidence.
    pub worst: Option<Worst>,
    /// Wrong blur most like the picture; none if it resembles none, or without evidence.
    pub resembles: Option<Resemblance>,
    /// Folder of the case's pictures, for a sequence its worst frame's; relative to `run.json`.
    pub pictures: PathBuf,
}

/// Estimates the samples per pixel that would settle the score: its interval would exclude the
/// limit. Assumes that the middle of the interval stays.
fn samples_to_settle(
    samples_per_pixel: u32,
    metric: Metric,
    [low, high]: [f64; 2],
    limit: f64,
) -> u64 {
    let middle = metric.ideal().badness((low + high) / 2.0);
    let apart = (middle - limit_as_badness(metric.ideal(), limit)).abs();
    settling_samples(samples_per_pixel, (high - low) / 2.0, apart)
}

/// Doubles samples per pixel until an uncertainty, which shrinks with their root, is as small as a
/// distance.
pub fn settling_samples(samples_per_pixel: u32, uncertainty: f64, distance: f64) -> u64 {
    let more = (uncertainty / distance).powi(2);
    let present = u64::from(samples_per_pixel);
    let mut samples = present;
    while (samples as f64) < more * present as f64 && samples < MAX_SAMPLES {
        samples *= 2;
    }
    samples
}

/// Upper limit on the samples per pixel of a truth: a score that needs as many or more stays
/// undecided.
pub const MAX_SAMPLES: u64 = tracer::MAX_SAMPLES as u64;

impl Finding {
    /// Makes the finding about a judged score of a case, or of the sequence that starts with it,
    /// without evidence.
    pub(super) fn new(
        run: &Run,
        case: &Case,
        sequence: Option<&Sequence>,
        judged: JudgedScore,
    ) -> Self {
        let JudgedScore {
            metric,
            bound,
            measured,
            outcome,
        } = judged;
        let (score, reason) = match measured {
            Measured::Score(score) => (Some(score), None),
            Measured::NotApplicable { reason } => (None, Some(reason)),
        };
        let sequence = sequence.filter(|_| outcome != Outcome::NotJudged);
        let intervals = match metric {
            Metric::Sequence(_) => sequence.map(|sequence| &sequence.intervals),
            _ => Some(&case.intervals),
        };
        let interval = intervals.and_then(|intervals| intervals.get(&metric).copied());
        let worst_frame = sequence.and_then(|sequence| sequence.worst_frames.get(&metric).copied());
        let worst =
            (sequence.zip(worst_frame)).and_then(|(sequence, at)| sequence.frames.get(at as usize));
        Self {
            outcome,
            level: bound.level,
            scene: case.scene.clone(),
            filter: case.name(),
            metric,
            unit: metric.unit().to_owned(),
            value: score.map(|score| score.value),
            interval,
            limit: bound.limit,
            floor: score.map(|score| score.floor),
            strictest: score.map(|score| metric.strictest_bound(score.floor)),
            frames: bound.length.map(|length| length.frames),
            fps: bound.length.and_then(|length| length.per_second),
            worst_frame,
            why: bound.why,
            place: bound.place,
            reason,
            settled_by: match (outcome, &interval) {
                (Outcome::Inconclusive, Some(interval)) => {
                    let ends = [interval.low, interval.high];
                    let samples = run.render.samples_per_pixel;
                    Some(samples_to_settle(samples, metric, ends, bound.limit))
                }
                _ => None,
            },
            subframes: case.drawn.as_ref().map(|drawn| drawn.subframes),
            worst: None,
            resembles: None,
            pictures: worst.map_or(&case.folder, |frame| &frame.folder).clone(),
        }
    }

    /// Returns true for a finding about a score of a sequence.
    pub fn is_of_sequence(&self) -> bool {
        self.frames.is_some()
    }

    /// Returns the decision from this finding alone.
    pub fn decision(&self) -> Decision {
        match (self.outcome, self.level) {
            (Outcome::TooNoisy, Level::Required) => Decision::Misconfigured,
            (Outcome::Broken, Level::Required) => Decision::Broken,
            (Outcome::Inconclusive, Level::Required) => Decision::Inconclusive,
            _ => Decision::Pass,
        }
    }

    /// Returns true for a finding about this case.
    pub fn is_of(&self, case: &Case) -> bool {
        self.scene == case.scene && self.filter == case.name()
    }

    /// Formats a score with its unit: `0.0921`, `1.31 px`.
    pub fn with_unit(&self, value: f64) -> String {
        match self.unit.as_str() {
            "" => number(value),
            unit => format!("{} {unit}", number(value)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_times_the_samples_settle_what_is_half_an_uncertainty_from_its_limit() {
        let psnr: Metric = "psnr_moving".parse().unwrap();
        for (metric, ends, limit, expected) in [
            // The half width is 0.0625, and the middle is that, a half, a quarter and a little more
            // away.
            (Metric::FLIP, [0.0625, 0.1875], 0.1875, 64),
            (Metric::FLIP, [0.0625, 0.1875], 0.15625, 256),
            (Metric::FLIP, [0.0625, 0.1875], 0.140625, 1024),
            (Metric::FLIP, [0.0625, 0.1875], 0.109, 1024),
            // The half width is 1 dB, and the middle is 1 dB above the limit.
            (psnr, [29.0, 31.0], 29.0, 64),
            (psnr, [29.0, 31.0], 29.5, 256),
            // Nothing settles what lies on its limit.
            (Metric::FLIP, [0.0625, 0.1875], 0.125, MAX_SAMPLES),
        ] {
            let samples = samples_to_settle(64, metric, ends, limit);
            assert_eq!(samples, expected, "{metric}: {ends:?} at {limit}");
        }
        // Three times the samples are not offered, because replicates are doubled.
        assert_eq!(settling_samples(64, 3f64.sqrt(), 1.0), 256);
        assert_eq!(settling_samples(64, 0.5, 1.0), 64);
    }
}
