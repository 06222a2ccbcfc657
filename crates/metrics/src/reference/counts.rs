//! Counts of equivalent sub-frames, from the rungs of the ladder.

use frame::{Ladder, Picture, Region};

use super::Reference;
use super::check::{check_brightness, check_ladder, check_picture};
use crate::color::cross_error::squared_error;
use crate::label::label_variation;
use crate::math::pooling::mean_over;
use crate::picture::pooled::Pooled;
use crate::picture::scores::Found;
use crate::subframes::ladder::{Curves, ErrorKind, Errors, RungTruth};
use crate::subframes::{Equivalent, equivalent};
use crate::{EquivalentMetric, EquivalentScores, MeasureError, Measured, Scores};

impl Reference<'_> {
    /// Adds rungs of the ladder, each with more sub-frames than those before. Memory then need not
    /// hold all of them at once.
    pub fn add_rungs(&mut self, ladder: &Ladder) -> Result<(), MeasureError> {
        check_ladder(ladder, self.truth)?;
        let has_noise = self.truth.provenance.engine.is_none();
        let truth = RungTruth {
            mean: &self.mean,
            half: if has_noise {
                &self.truth.halves[0]
            } else {
                &self.mean
            },
            seen: &self.seen.display,
        };
        for rung in &ladder.rungs {
            self.errors
                .curves
                .add(rung, &truth, &self.regions, &self.viewing);
        }
        Ok(())
    }

    /// Returns the errors of the rungs.
    pub fn curves(&self) -> &Curves {
        &self.errors.curves
    }

    /// Measures the errors alone that equivalent sub-frames are counted by; none if nothing moves.
    pub fn measure_errors(&self, output: &Picture) -> Result<Option<Errors>, MeasureError> {
        check_picture(output, self.truth, "the output")?;
        check_brightness(output, &self.viewing, "the output")?;
        let halves = self.halves_for(&output.color);
        let squared = squared_error(&output.color, halves.each_ref(), self.viewing.scale());
        let flip = (self.seen.display).map_errors(&self.display(output).linear);
        let label = label_variation(&output.coverage, &self.mean.coverage);
        let mse = mean_over(&squared, &self.regions, Region::Moving);
        let flip = mean_over(&flip, &self.regions, Region::Moving);
        let label = mean_over(&label, &self.regions, Region::Moving);
        let found = mse.zip(flip).zip(label);
        Ok(found.map(|((mse, flip), label)| Errors { mse, flip, label }))
    }

    /// Counts the equivalent sub-frames of a measured picture again, with intervals. `without`
    /// holds the reference without each group of samples (truth and ladder), and the errors against
    /// it of the picture without that group, by [`Reference::measure_errors`]. Counts that do not
    /// apply stay so.
    pub fn count_subframes(
        &self,
        scores: &Scores,
        without: &[(&Reference, Errors)],
    ) -> EquivalentScores {
        let mut counts = scores.equivalent_subframes.clone();
        let without = without.iter();
        let without: Vec<(Errors, &Curves)> = without
            .map(|(reference, errors)| (*errors, &reference.errors.curves))
            .collect();
        if let Some((own, noise)) = measured_errors(scores)
            && !self.errors.curves.is_empty()
        {
            let found = self.count_all(&own, &noise, &without);
            for metric in EquivalentMetric::ALL {
                if let Equivalent::Subframes(_) = counts.get(metric) {
                    *counts.get_mut(metric) = found.get(metric).clone();
                }
            }
        }
        counts
    }

    /// Counts by every kind of error.
    fn count_all(
        &self,
        errors: &Errors,
        noise: &Errors,
        without: &[(Errors, &Curves)],
    ) -> EquivalentScores {
        let count = |kind| equivalent(kind, errors, &self.errors.curves, noise, without);
        EquivalentScores {
            mse: count(ErrorKind::Mse),
            flip: count(ErrorKind::Flip),
            label_total_variation: count(ErrorKind::Label),
        }
    }

    pub(super) fn score_equivalents(&self, moving: &Found) -> EquivalentScores {
        let missing = |reason: &str| EquivalentScores {
            mse: Equivalent::not_applicable(reason),
            flip: Equivalent::not_applicable(reason),
            label_total_variation: Equivalent::not_applicable(reason),
        };
        if self.errors.curves.is_empty() {
            return missing("no ladder of accumulations was given");
        }
        match moving {
            Ok((own, noise)) => {
                let [own, noise] = [*own, *noise].each_ref().map(Errors::from);
                self.count_all(&own, &noise, &[])
            }
            Err(reason) => missing(reason),
        }
    }
}

/// Returns a picture's errors over the moving region, without those of a label if it has none, and
/// those of the truth's noise; none if nothing moves.
fn measured_errors(scores: &Scores) -> Option<(Errors, Errors)> {
    let score = |measured: &Measured| match measured {
        Measured::Score(score) => Some((score.value, score.floor)),
        Measured::NotApplicable { .. } => None,
    };
    let (mse, flip) = (score(&scores.moving.mse)?, score(&scores.moving.flip)?);
    // A picture without mattes has no count by labels.
    let label = score(&scores.label_total_variation.mean).unwrap_or_default();
    let errors = |part: fn((f64, f64)) -> f64| Errors {
        mse: part(mse),
        flip: part(flip),
        label: part(label),
    };
    Some((errors(|score| score.0), errors(|score| score.1)))
}

impl From<&Pooled> for Errors {
    fn from(pooled: &Pooled) -> Self {
        Self {
            mse: pooled.mse,
            flip: pooled.flip,
            label: pooled.label,
        }
    }
}
