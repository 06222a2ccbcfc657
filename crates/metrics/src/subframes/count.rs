//! The count of sub-frames with a picture's error, and its interval.

use super::ladder::{Curves, Errors};
use super::{Equivalent, LadderRange, Subframes};
use crate::{EquivalentMetric, EquivalentScores, jackknife};

/// Counts the accumulated sub-frames with the errors `own`. `without` holds the picture's errors and the rungs' without each
/// group of samples in turn: of the picture's frame, the truth and the rungs together.
///
/// A count N is possible if the 95 % interval of the difference between the picture's error and the rung's contains 0. So the
/// interval of the count comes from [`jackknife`] intervals of the difference at every rung, and the count itself from their
/// centres. Between two rungs, errors are interpolated in logarithms.
///
/// Without groups (a truth of two replicates, an engine's), nothing is known of the difference's noise. Then counts up to the
/// floor are taken as certain and others as open: see [`Subframes::floor`]. `noise` holds the errors of the truth's own noise.
pub fn count_equivalents(
    own: &Errors,
    curves: &Curves,
    noise: &Errors,
    without: &[(Errors, &Curves)],
) -> EquivalentScores {
    let count = |metric| Equivalent::Subframes(count(metric, (own, curves), noise, without));
    EquivalentScores {
        mse: count(EquivalentMetric::Mse),
        flip: count(EquivalentMetric::Flip),
        label_total_variation: count(EquivalentMetric::LabelTotalVariation),
    }
}

fn count(
    metric: EquivalentMetric,
    (own, curves): (&Errors, &Curves),
    noise: &Errors,
    without: &[(Errors, &Curves)],
) -> Subframes {
    let own = own.square(metric);
    let plain = curves.rungs.iter();
    let plain = plain.map(|rung| (f64::from(rung.subframes), rung.plain.square(metric)));
    let (floor, _) = Ladder(plain.collect()).find(noise.square(metric));
    let ladder = |value: &dyn Fn(usize) -> f64| {
        let rungs = curves.rungs.iter().enumerate();
        Ladder(
            rungs
                .map(|(at, rung)| (f64::from(rung.subframes), own - value(at)))
                .collect(),
        )
    };
    let difference =
        |own: f64, curves: &Curves, at: usize| own - curves.rungs[at].noisy.square(metric);
    let intervals: Option<Vec<_>> = (0..curves.rungs.len())
        .map(|at| {
            let others = without.iter();
            let others: Vec<f64> = others
                .map(|(own, curves)| difference(own.square(metric), curves, at))
                .collect();
            jackknife(difference(own, curves, at), &others)
        })
        .collect();
    match intervals {
        Some(intervals) => {
            let (value, range) = ladder(&|at| intervals[at].center).find(own);
            Subframes {
                value,
                floor,
                low: ladder(&|at| intervals[at].high).first_possible(own),
                high: ladder(&|at| intervals[at].low).last_possible(own),
                range,
            }
        }
        None => {
            let (value, range) = ladder(&|at| difference(own, curves, at)).find(own);
            Subframes::of_floor(value, floor, range)
        }
    }
}

/// Pairs of sub-frames and error, sub-frames rising. Noise can make an error rise, or negative.
struct Ladder(Vec<(f64, f64)>);

impl Ladder {
    /// Finds the count of sub-frames with this error: the lowest of several; the ladder's end if the error is beyond it.
    fn find(&self, error: f64) -> (f64, LadderRange) {
        let (first, last) = (self.0[0], self.0[self.0.len() - 1]);
        if error > first.1 {
            return (first.0, LadderRange::Below);
        }
        match self.first_possible(error) {
            Some(count) if count < last.0 || error == last.1 => (count, LadderRange::Within),
            _ => (last.0, LadderRange::Above),
        }
    }

    /// Finds the lowest count whose error is at most this one; the last if no error is; none if it may be below the first.
    fn first_possible(&self, error: f64) -> Option<f64> {
        let rungs = &self.0;
        match rungs.iter().position(|rung| rung.1 <= error) {
            None => Some(rungs[rungs.len() - 1].0),
            Some(0) => (rungs[0].1 == error).then_some(rungs[0].0),
            Some(at) => Some(interpolate(rungs[at - 1], rungs[at], error)),
        }
    }

    /// Finds the highest count whose error is at least this one; the first if no error is; none if it may be above the last.
    fn last_possible(&self, error: f64) -> Option<f64> {
        let rungs = &self.0;
        match rungs.iter().rposition(|rung| rung.1 >= error) {
            None => Some(rungs[0].0),
            Some(at) if at + 1 == rungs.len() => (rungs[at].1 == error).then_some(rungs[at].0),
            Some(at) => Some(interpolate(rungs[at], rungs[at + 1], error)),
        }
    }
}

/// Interpolates the count with an error between two rungs: in logarithms, of the count alone if an error is not positive.
fn interpolate(low: (f64, f64), high: (f64, f64), error: f64) -> f64 {
    // A rung's own error is its own count; through logarithms it would be off by a rounding.
    if error == high.1 {
        return high.0;
    }
    let fraction = if high.1 > 0.0 {
        (low.1 / error).ln() / (low.1 / high.1).ln()
    } else {
        (low.1 - error) / (low.1 - high.1)
    };
    (low.0.ln() + fraction * (high.0 / low.0).ln()).exp()
}
