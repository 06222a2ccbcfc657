//! Scores of a case for tables, means over scenes and pages.

use metrics::{Interval, Measured, Metric};

use super::case::Case;
use crate::identity::ReferencePicture;

impl Case {
    /// Returns a score.
    pub fn measured(&self, metric: Metric) -> Measured {
        match metric {
            Metric::CommonFlip => self.common.flip.clone(),
            _ => self.scores.get(metric),
        }
    }

    /// Finds the noise floor of a score; none if the score does not apply.
    pub fn floor(&self, metric: Metric) -> Option<f64> {
        match self.measured(metric) {
            Measured::Score(score) => Some(score.floor),
            Measured::NotApplicable { .. } => None,
        }
    }

    /// Finds the interval of a score; none if the run has no intervals.
    pub fn interval(&self, metric: Metric) -> Option<&Interval> {
        self.intervals.get(&self.scores.behind(metric))
    }

    /// Estimates a score against a truth without noise, which needs an interval; without one,
    /// returns the measured score. None if the score does not apply.
    pub fn estimate(&self, metric: Metric) -> Option<f64> {
        let measured = self.measured(metric).value()?;
        let interval = self.interval(metric);
        Some(interval.map_or(measured, |interval| interval.center))
    }

    /// Formats an estimated score: `0.063`, `4.80>`, `<1`, `n/a`.
    pub fn score_text(&self, metric: Metric) -> String {
        self.scores.text(metric, self.estimate(metric))
    }

    /// Returns the weight of the case's scene in a mean over scenes: for a skill, how much the
    /// one-frame oracle reduces the error of no blur; for any other score, 1. None if `cases`, all
    /// cases of its run, lack the reference pictures.
    pub fn weight(&self, metric: Metric, cases: &[Case]) -> Option<f64> {
        let Metric::Skill(skill) = metric else {
            return Some(1.0);
        };
        let error = |is_wanted: fn(&Case) -> bool| {
            let case = cases.iter().find(|case| {
                is_wanted(case) && (&case.scene, case.alignment) == (&self.scene, self.alignment)
            });
            case?.scores.get(skill.error()).value()
        };
        // The frame is the sharp picture if its instant is the middle of the shutter.
        let sharp = error(Case::is_sharp)
            .or_else(|| error(|case| case.reference() == Some(ReferencePicture::Identity)));
        Some(sharp? - error(|case| case.reference() == Some(ReferencePicture::ScatterOracle))?)
    }
}
