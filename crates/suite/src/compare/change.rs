//! One score of one case in two runs.

use metrics::{Measured, Metric};
use serde::Serialize;

use super::pairing::{Pair, subject};

/// A score that both runs have.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Change {
    /// With its variant.
    pub scene: String,
    /// `jump_flood:paper`; bars with their alignment.
    pub filter: String,
    /// Whether it is a bar, and no filter.
    pub bar: bool,
    /// Name of the metric.
    pub metric: String,
    /// In the first run, in the metric's unit.
    pub first: f64,
    /// In the second one.
    pub second: f64,
    /// By how much the second is worse; negative is better.
    pub worse: f64,
    /// How much the scene counts in a mean over scenes: 1, or of a skill the error that the one-frame oracle takes away.
    pub weight: f64,
    /// Where that lies against a truth without noise with a confidence of 95 %; none without replicates.
    pub interval: Option<[f64; 2]>,
    /// Its standard error; 0 where nothing changed, none without replicates.
    pub standard_error: Option<f64>,
    /// What it was told from noise by.
    pub basis: Basis,
    /// The verdict.
    pub kind: ChangeKind,
}

/// What tells a change from noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Basis {
    /// The replicates of the truth, left out two by two of both scores at once: what noise the scores share falls out.
    Replicates,
    /// The larger of both scores' noise floors: the replicates or the pictures are not there.
    Floor,
}

/// Whether a score changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ChangeKind {
    /// Not by a bit.
    Same,
    /// By no more than the truth's noise could make.
    WithinNoise,
    /// By more than noise, and less than matters.
    BelowMargin,
    /// The second is better.
    Better,
    /// The second is worse.
    Worse,
}

impl ChangeKind {
    /// Every kind, the worst first.
    pub const ALL: [ChangeKind; 5] = [
        ChangeKind::Worse,
        ChangeKind::Better,
        ChangeKind::BelowMargin,
        ChangeKind::WithinNoise,
        ChangeKind::Same,
    ];

    /// As a report says it.
    pub fn words(self) -> &'static str {
        match self {
            Self::Same => "same",
            Self::WithinNoise => "within noise",
            Self::BelowMargin => "below the margin",
            Self::Better => "better",
            Self::Worse => "worse",
        }
    }
}

/// How far a difference may be off because the truth is noisy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertainty {
    /// The lower and the upper end of its 95 % interval.
    pub interval: [f64; 2],
    /// Its standard error.
    pub standard_error: f64,
}

impl Change {
    /// None where the metric does not apply to both.
    pub fn of(
        pair: &Pair,
        metric: Metric,
        weight: f64,
        uncertainty: Option<Uncertainty>,
    ) -> Option<Self> {
        let (Measured::Score(first), Measured::Score(second)) = (
            pair.first.scores.get(metric),
            pair.second.scores.get(metric),
        ) else {
            return None;
        };
        let badness = |value: f64| metric.ideal().badness(value);
        let worse = badness(second.value) - badness(first.value);
        let floor = first.floor.max(second.floor);
        let interval = uncertainty.map_or([worse - floor, worse + floor], |own| own.interval);
        Some(Self {
            scene: pair.first.scene.clone(),
            filter: subject(pair.first),
            bar: pair.first.bar,
            metric: metric.name(),
            first: first.value,
            second: second.value,
            worse,
            weight,
            interval: uncertainty.map(|own| own.interval),
            standard_error: match worse == 0.0 {
                true => Some(0.0),
                false => uncertainty.map(|own| own.standard_error),
            },
            basis: match uncertainty {
                Some(_) => Basis::Replicates,
                None => Basis::Floor,
            },
            kind: kind(worse, interval),
        })
    }

    /// Whether it is better or worse.
    pub fn is_beyond_noise(&self) -> bool {
        matches!(self.kind, ChangeKind::Better | ChangeKind::Worse)
    }

    /// The change as a part of the larger score.
    pub fn size(&self) -> f64 {
        match self.first.abs().max(self.second.abs()) {
            0.0 => 0.0,
            larger => self.worse.abs() / larger,
        }
    }
}

/// Scene and filter of cases that changed by more than noise, by the largest part of a score that changed.
pub fn rank_changes(changes: &[Change]) -> Vec<(&str, &str)> {
    let mut ranked: Vec<(f64, (&str, &str))> = Vec::new();
    for change in changes.iter().filter(|change| change.is_beyond_noise()) {
        let key = (change.scene.as_str(), change.filter.as_str());
        match ranked.iter_mut().find(|(_, own)| *own == key) {
            Some((size, _)) => *size = size.max(change.size()),
            None => ranked.push((change.size(), key)),
        }
    }
    ranked.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    ranked.into_iter().map(|(_, key)| key).collect()
}

/// What a difference and its interval come to.
fn kind(worse: f64, [low, high]: [f64; 2]) -> ChangeKind {
    if worse == 0.0 {
        ChangeKind::Same
    } else if low > 0.0 {
        ChangeKind::Worse
    } else if high < 0.0 {
        ChangeKind::Better
    } else {
        ChangeKind::WithinNoise
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_what_its_interval_leaves_no_doubt_of() {
        for (worse, interval, expected) in [
            (0.0, [-0.1, 0.1], ChangeKind::Same),
            (0.2, [0.1, 0.3], ChangeKind::Worse),
            (-0.2, [-0.3, -0.1], ChangeKind::Better),
            (0.2, [-0.1, 0.5], ChangeKind::WithinNoise),
            (-0.2, [-0.4, 0.0], ChangeKind::WithinNoise),
        ] {
            assert_eq!(kind(worse, interval), expected, "{worse} {interval:?}");
        }
    }
}
