//! The count of sub-frames with a picture's error, and its interval.

use super::curve::{Curve, Point};
use super::ladder::{Curves, Errors};
use super::{Equivalent, Subframes};
use crate::{EquivalentMetric, EquivalentScores, jackknife};

/// Counts the accumulated sub-frames with the errors `own`. `without` holds the picture's errors and the rungs' without each
/// group of samples in turn: of the picture's frame, the truth and the rungs together. `noise` holds the errors that the truth's
/// noise alone makes.
///
/// A count N is possible if the 95 % interval of the difference between the picture's error and the rung's contains 0. So the
/// interval of the count comes from [`jackknife`] intervals of the difference at every rung, and the count itself from their
/// centres. FLIP and label variation are compared in squares, which noise raises by its variance.
///
/// Without groups (a truth of two replicates, an engine's), nothing is known of the difference's noise. Then counts up to
/// [`Subframes::floor`] are taken as certain and others as open.
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
    let error = own.square(metric);
    let difference = |own: &Errors, curves: &Curves, at: usize| {
        own.square(metric) - curves.rungs[at].noisy.square(metric)
    };
    let points: Vec<Point> = (curves.rungs.iter().enumerate())
        .map(|(at, rung)| {
            let others = without.iter();
            let others: Vec<f64> = others
                .map(|(own, curves)| difference(own, curves, at))
                .collect();
            let whole = difference(own, curves, at);
            let found = jackknife(whole, &others);
            // The rung's error is the picture's less the difference.
            let [center, low, high] =
                found.map_or([whole; 3], |own| [own.center, own.low, own.high]);
            Point {
                subframes: f64::from(rung.subframes),
                error: error - center,
                below: high - center,
                above: center - low,
            }
        })
        .collect();
    let exact = |plain: &super::ladder::Rung| Point {
        subframes: f64::from(plain.subframes),
        error: plain.plain.square(metric),
        below: 0.0,
        above: 0.0,
    };
    let plain = Curve(curves.rungs.iter().map(exact).collect());
    let (floor, _) = plain.find(noise.square(metric));
    let curve = Curve(points);
    let (value, range) = curve.find(error);
    if without.len() < 2 {
        return Subframes::of_floor(value, floor, range);
    }
    Subframes {
        value,
        floor,
        low: curve.lowest(error),
        high: curve.highest(error),
        range,
    }
}
