//! Change of one score of one case between two runs.

use measure::FilterId;
use metrics::{Ideal, Measured, Metric};
use scene::SceneId;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use crate::compare::pairing::Pair;
use crate::groups::group_by;

/// A score that both runs have.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Change {
    /// Scene.
    pub scene: SceneId,
    /// Filter or reference; in files its text as `filter`, and `bar`, which is true for a
    /// reference.
    #[serde(flatten, serialize_with = "write_filter")]
    pub filter: FilterId,
    /// Score.
    pub metric: Metric,
    /// Score in the first run, in the metric's unit.
    pub first: f64,
    /// Score in the second run.
    pub second: f64,
    /// Amount by which the second is worse; negative is better.
    pub worse: f64,
    /// Both scores as estimated against a truth without noise; as measured if there are no
    /// replicates.
    pub estimates: [f64; 2],
    /// Weight of the scene in a mean over scenes: 1, or for a skill the error that the one-frame
    /// oracle removes.
    pub weight: f64,
    /// 95 % confidence interval of `worse` against a truth without noise; none without replicates.
    pub interval: Option<[f64; 2]>,
    /// Standard error of `worse`; 0 if nothing changed, none without replicates.
    pub standard_error: Option<f64>,
    /// Measure of the noise.
    pub basis: Basis,
    /// Verdict.
    pub kind: ChangeKind,
}

/// Measure of the noise that a change is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Basis {
    /// The truth's replicates, left out in pairs from both scores at once, so that noise in both
    /// cancels.
    Replicates,
    /// The larger noise floor of the two scores: replicates or pictures are missing.
    Floor,
}

/// Verdict on the change of a score, or of a mean of scores.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ChangeKind {
    /// Equal to the last bit; for a mean, in every scene.
    Same,
    /// No more than the truth's noise can explain.
    WithinNoise,
    /// More than noise, and less than the margin.
    BelowMargin,
    /// The second is better.
    Better,
    /// The second is worse.
    Worse,
    /// The interval of a mean contains 0.
    Undecided,
    /// Too few scenes to trust the interval of a mean.
    TooFewScenes,
}

impl ChangeKind {
    /// Verdicts on a score, the worst first.
    pub const OF_SCORES: [Self; 5] = [
        Self::Worse,
        Self::Better,
        Self::BelowMargin,
        Self::WithinNoise,
        Self::Same,
    ];

    /// Returns true if the second is better or worse.
    pub fn is_decided(self) -> bool {
        matches!(self, Self::Better | Self::Worse)
    }

    /// Returns its words for a report.
    pub fn label(self) -> &'static str {
        match self {
            Self::Same => "same",
            Self::WithinNoise => "within noise",
            Self::BelowMargin => "within margin",
            Self::Better => "better",
            Self::Worse => "worse",
            Self::Undecided => "undecided",
            Self::TooFewScenes => "few scenes",
        }
    }
}

/// Uncertainty of a difference, from the truth's noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertainty {
    /// Ends of its 95 % confidence interval.
    pub interval: [f64; 2],
    /// Its standard error.
    pub standard_error: f64,
    /// Both scores as estimated against a truth without noise.
    pub estimates: [f64; 2],
}

impl Change {
    /// Compares a score of both cases; none if the metric does not apply to both.
    pub fn new(
        pair: &Pair,
        metric: Metric,
        weight: f64,
        uncertainty: Option<Uncertainty>,
    ) -> Option<Self> {
        let [first, second] = [pair.first, pair.second].map(|case| case.scores.get(metric));
        let (Measured::Score(first), Measured::Score(second)) = (first, second) else {
            return None;
        };
        let badness = |value: f64| metric.ideal().badness(value);
        let worse = badness(second.value) - badness(first.value);
        let floor = first.floor.max(second.floor);
        let interval = uncertainty.map_or([worse - floor, worse + floor], |uncertainty| {
            uncertainty.interval
        });
        Some(Self {
            scene: pair.first.scene.clone(),
            filter: pair.first.filter_id(),
            metric,
            first: first.value,
            second: second.value,
            worse,
            estimates: uncertainty.map_or([first.value, second.value], |uncertainty| {
                uncertainty.estimates
            }),
            weight,
            interval: uncertainty.map(|uncertainty| uncertainty.interval),
            standard_error: if worse == 0.0 {
                Some(0.0)
            } else {
                uncertainty.map(|uncertainty| uncertainty.standard_error)
            },
            basis: match uncertainty {
                Some(_) => Basis::Replicates,
                None => Basis::Floor,
            },
            kind: classify(worse, interval),
        })
    }

    /// Estimates how much worse the second is against a truth without noise.
    pub fn estimate(&self) -> f64 {
        let [first, second] = self
            .estimates
            .map(|value| self.metric.ideal().badness(value));
        second - first
    }

    /// Returns the change as a fraction of the larger score.
    fn size(&self) -> f64 {
        match self.first.abs().max(self.second.abs()) {
            0.0 => 0.0,
            larger => self.estimate().abs() / larger,
        }
    }
}

/// Converts a change for the worse to a change of the score, which is reversed if higher is better.
pub fn score_change(metric: Metric, worse: f64) -> f64 {
    match metric.ideal() {
        Ideal::Highest => -worse,
        _ => worse,
    }
}

/// Ranks the cases that changed by more than noise by their largest relative change; returns scene
/// and filter.
pub fn rank_changes(changes: &[Change]) -> Vec<(&SceneId, &FilterId)> {
    let decided = changes.iter().filter(|change| change.kind.is_decided());
    let mut ranked = group_by(decided, |change| (&change.scene, &change.filter));
    let size = |case: &[&Change]| case.iter().map(|change| change.size()).fold(0.0, f64::max);
    ranked.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let cases = ranked.iter().map(|case| case[0]);
    cases
        .map(|change| (&change.scene, &change.filter))
        .collect()
}

fn write_filter<S: Serializer>(filter: &FilterId, serializer: S) -> Result<S::Ok, S::Error> {
    let mut fields = serializer.serialize_map(Some(2))?;
    fields.serialize_entry("filter", &filter.to_string())?;
    fields.serialize_entry("bar", &filter.is_reference)?;
    fields.end()
}

/// Classifies a difference by its interval.
fn classify(worse: f64, [low, high]: [f64; 2]) -> ChangeKind {
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
pub(super) mod tests {
    use frame::Alignment;

    use super::*;

    /// Makes a change from 0.5 of one filter.
    pub fn change(scene: &str, metric: Metric, worse: f64, kind: ChangeKind) -> Change {
        Change {
            scene: SceneId::new(scene, None),
            filter: FilterId {
                is_reference: false,
                name: "one:paper".to_owned(),
                alignment: Alignment::Centred,
            },
            metric,
            first: 0.5,
            second: 0.5 + worse,
            worse,
            estimates: [0.5, 0.5 + worse],
            weight: 1.0,
            interval: None,
            standard_error: None,
            basis: Basis::Floor,
            kind,
        }
    }

    #[test]
    fn a_change_is_what_its_interval_leaves_no_doubt_of() {
        for (worse, interval, expected) in [
            (0.0, [-0.1, 0.1], ChangeKind::Same),
            (0.2, [0.1, 0.3], ChangeKind::Worse),
            (-0.2, [-0.3, -0.1], ChangeKind::Better),
            (0.2, [-0.1, 0.5], ChangeKind::WithinNoise),
            (-0.2, [-0.4, 0.0], ChangeKind::WithinNoise),
        ] {
            assert_eq!(classify(worse, interval), expected, "{worse} {interval:?}");
        }
    }
}
