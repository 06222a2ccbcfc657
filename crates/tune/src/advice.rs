//! Advice on the choice of a tuning: take it, or keep the start.

use crate::comparison::{Difference, PairedComparison, Preference, pair_scores};
use crate::tuning::Tuning;

/// Smallest change of the log of the error that justifies another value: half of the last digit of
/// a change in tables.
const LEAST_CHANGE: f64 = 5e-4;

/// Advice on the choice of a tuning.
#[derive(Clone, Debug, PartialEq)]
pub enum Advice {
    /// Take the choice.
    Take,
    /// Keep the start: no trial beats it.
    NoneIsBetter,
    /// Keep the start: the scenes tuned on do not show that the choice is better.
    CannotTell(Difference),
    /// Keep the start: it is better on the held-out scenes.
    StartIsBetter(Difference),
}

impl Tuning {
    /// Advises to take the choice, or to keep the start.
    pub fn advice(&self) -> Advice {
        if self.choice.trial == 0 {
            return Advice::NoneIsBetter;
        }
        if let Some(difference) = self
            .compare_with_start()
            .filter(|difference| !is_better(difference))
        {
            return Advice::CannotTell(difference);
        }
        let held_out = self.held_out.last().map(|result| &result.paired.flip);
        match held_out.filter(|flip| flip.verdict == Preference::First) {
            Some(flip) => Advice::StartIsBetter(flip.clone()),
            None => Advice::Take,
        }
    }

    /// Compares the choice with the start on the scenes tuned on; none without common scenes.
    fn compare_with_start(&self) -> Option<Difference> {
        let pairs = pair_scores(&self.start.scenes, &self.chosen.scenes);
        (!pairs.is_empty()).then(|| PairedComparison::new(pairs).flip)
    }
}

/// Returns whether the scenes show that the choice is better than the start.
fn is_better(difference: &Difference) -> bool {
    difference.verdict == Preference::Second && difference.mean < -LEAST_CHANGE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_that_the_scenes_cannot_tell_from_nothing_is_not_offered() {
        let difference = |mean, verdict| Difference {
            mean,
            interval: [mean - 0.01, mean + 0.01],
            scenes: 5,
            verdict,
        };
        assert!(is_better(&difference(-0.05, Preference::Second)));
        assert!(!is_better(&difference(-0.05, Preference::Undecided)));
        // `taps` 8 -> 11 for -0.0 %.
        assert!(!is_better(&difference(-0.0003, Preference::Second)));
    }
}
