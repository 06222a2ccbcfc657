//! Jackknife intervals of scores, from parts of the replicates of frame and truth.

use crate::LADDER;
use metrics::{
    Equivalent, FrozenMetric, Ideal, ImageMetric, ImageScores, Interval, Measured, Metric,
    ObjectMetric, PSNR_LIMIT, ProbeMetric, Region, Rise, Scores, SequenceMetric, SequenceScores,
    SkillMetric, jackknife, jackknife_of, psnr,
};

use crate::run::case::Intervals;

/// First and last number of sub-frames of the ladder.
const LADDER_ENDS: [u32; 2] = [LADDER[0], LADDER[LADDER.len() - 1]];

/// Computes the interval of each of `metrics` that has a score of the whole and of all `parts`,
/// each without one of the [`Groups`](crate::Groups) of replicates. `still` are the scores of the
/// frame itself where nothing moves: its errors there may all be noise. Counts of equivalent
/// sub-frames have an interval of their own, with the ladder's ends for open ends.
pub fn intervals(
    whole: &Scores,
    parts: &[Scores],
    still: &ImageScores,
    metrics: impl IntoIterator<Item = Metric>,
) -> Intervals {
    (metrics.into_iter())
        .filter_map(|metric| {
            let interval = match metric {
                Metric::Object(object) => worst_interval(whole, parts, metric, object, true),
                Metric::Image(ImageMetric::Psnr, region) => {
                    let error = Metric::Image(ImageMetric::Mse, region);
                    let parts = parts.iter().map(|scores| scores.get(error).value());
                    psnr_interval(&whole.get(error), parts)
                }
                Metric::Image(ImageMetric::Grain, _) => {
                    let parts = parts.iter().map(|scores| scores.get(metric).value());
                    grain_interval(&whole.get(metric), parts)
                }
                Metric::Image(kind, Region::Still) => {
                    let parts = parts.iter().map(|scores| scores.get(metric).value());
                    let whole_interval = interval(&whole.get(metric), parts, metric);
                    whole_interval.map(|interval| reach_below(interval, still.get(kind), metric))
                }
                Metric::OccluderContamination => {
                    let object = ObjectMetric::LabelTotalVariation;
                    worst_interval(whole, parts, metric, object, false)
                }
                Metric::Equivalent(count) => match whole.equivalent_subframes.get(count) {
                    Equivalent::Subframes(count) => Some(count.interval(LADDER_ENDS)),
                    Equivalent::NotApplicable { .. } => None,
                },
                _ => {
                    let parts = parts.iter().map(|scores| scores.get(metric).value());
                    interval(&whole.get(metric), parts, metric)
                }
            };
            Some((metric, interval?))
        })
        .collect()
}

/// Computes the intervals of a sequence's scores like [`intervals`] for a picture.
pub(crate) fn sequence_intervals(whole: &SequenceScores, parts: &[SequenceScores]) -> Intervals {
    (SequenceMetric::ALL.into_iter())
        .filter_map(|metric| {
            let parts = parts.iter().map(|scores| scores.get(metric).value());
            let named = Metric::Sequence(metric);
            Some((named, interval(whole.get(metric), parts, named)?))
        })
        .collect()
}

/// Slowest power of the number of replicates by which noise in a mean of absolute errors falls.
const ROOT: f64 = 0.5;
/// The same for errors over the whole picture. Most of the picture is still: its noise is of few
/// samples, and FLIP raises small differences to the power of 0.7.
const SLOW: f64 = 0.3;

/// Grain that no picture shows: the slope of the root is finite.
const LEAST_GRAIN: f64 = 1e-6;

/// Returns how noise raises a score.
fn find_rise(metric: Metric) -> Rise {
    use ImageMetric::{Flip, FlipHdr, FlipWeightedMedian, Mae, Smape};
    match metric {
        Metric::Image(FlipWeightedMedian, Region::Full) => Rise::Percentile(Some(SLOW)),
        _ if metric.row().is_percentile => Rise::Percentile(None),
        Metric::Image(Flip | FlipHdr | Mae | Smape, Region::Still | Region::Full) => {
            Rise::Power(SLOW)
        }
        Metric::Image(Flip | FlipHdr | Mae | Smape, _)
        | Metric::Frozen(FrozenMetric::Flip)
        | Metric::Skill(SkillMetric::Flip | SkillMetric::Mse)
        | Metric::Object(ObjectMetric::RowLoss)
        | Metric::Probe(ProbeMetric::GatherOffset | ProbeMetric::GatherSpread) => Rise::Power(ROOT),
        _ => Rise::Inverse,
    }
}

/// Computes the interval of one score; none if it does not apply to every part.
fn interval(
    whole: &Measured,
    without: impl Iterator<Item = Option<f64>>,
    metric: Metric,
) -> Option<Interval> {
    let without: Vec<f64> = without.collect::<Option<_>>()?;
    jackknife_of(whole.value()?, &without, find_rise(metric))
}

/// Extends the interval of a score over still pixels downwards by the frame's own score there,
/// since all of that may be noise. Where only few samples see what light changes, parts of the
/// samples do not tell how much of it is.
fn reach_below(interval: Interval, frame: &Measured, metric: Metric) -> Interval {
    let is_raised = find_rise(metric) != Rise::Inverse;
    let noise = frame.value().filter(|_| is_raised).unwrap_or(0.0);
    let half_width = interval.high - interval.center;
    Interval {
        low: interval.low.min(interval.center - noise - half_width),
        ..interval
    }
}

/// Computes the interval of grain from its squares, which noise raises by the inverse of the
/// replicates. A square below the floor's cannot be told from none.
fn grain_interval(
    whole: &Measured,
    without: impl Iterator<Item = Option<f64>>,
) -> Option<Interval> {
    let Measured::Score(score) = whole else {
        return None;
    };
    let square = |value: f64| value * value.abs();
    let squares: Vec<f64> = without
        .map(|part| part.map(square))
        .collect::<Option<_>>()?;
    let square_interval = jackknife(square(score.value), &squares)?;
    let [low, center, high] = [
        square_interval.low,
        square_interval.center,
        square_interval.high,
    ]
    .map(|end| end.max(0.0).sqrt());
    Some(Interval {
        low,
        high: high.max(score.floor),
        center,
        standard_error: square_interval.standard_error
            / (2.0 * center.max(score.floor).max(LEAST_GRAIN)),
    })
}

/// Converts the interval of a squared error to that of PSNR. An error that may be none leaves the
/// end open at the limit of PSNR.
fn psnr_interval(
    squared_error: &Measured,
    without: impl Iterator<Item = Option<f64>>,
) -> Option<Interval> {
    let Measured::Score(score) = squared_error else {
        return None;
    };
    let without: Vec<f64> = without.collect::<Option<_>>()?;
    let error = jackknife(score.value, &without)?;
    let [low, center, high] = [
        (error.high, 0.0),
        (error.center, score.floor),
        (error.low, 0.0),
    ]
    .map(|(mse, floor)| psnr(mse, floor));
    // The slope of 10 log10, at an error that the truth can tell from none.
    let known = error
        .center
        .max(score.floor)
        .max(10f64.powf(-PSNR_LIMIT / 10.0));
    let slope = 10.0 / (std::f64::consts::LN_10 * known);
    Some(Interval {
        low,
        high,
        center,
        standard_error: slope * error.standard_error,
    })
}

/// Computes the interval of the worst object's score. The worst object of noisy pictures need not
/// be the worst without noise. Every object may be the worst, if its interval reaches the least
/// that the worst must have.
fn worst_interval(
    whole: &Scores,
    parts: &[Scores],
    metric: Metric,
    object: ObjectMetric,
    moves: bool,
) -> Option<Interval> {
    let ideal = metric.ideal();
    let of_object = |at: usize| {
        let scores = &whole.objects[at];
        let parts = parts
            .iter()
            .map(|scores| scores.objects[at].get(object).value());
        (scores.moves == moves).then(|| interval(scores.get(object), parts, metric))?
    };
    let all: Vec<Interval> = (0..whole.objects.len()).filter_map(of_object).collect();
    join_worst(&all, ideal)
}

/// Joins the intervals of all objects that may have the worst score.
fn join_worst(all: &[Interval], ideal: Ideal) -> Option<Interval> {
    let least = |interval: &Interval| ideal.badness_within(interval).0;
    let most = |interval: &Interval| ideal.badness_within(interval).1;
    let certain = all.iter().map(least).fold(f64::NEG_INFINITY, f64::max);
    let mut candidates = (all.iter())
        .filter(|interval| most(interval) >= certain)
        .map(|interval| without_better(*interval, ideal, certain));
    let first = candidates.next()?;
    Some(candidates.fold(first, |joined, interval| {
        let is_worse = ideal.badness(interval.center) > ideal.badness(joined.center);
        let worst = if is_worse { interval } else { joined };
        Interval {
            low: joined.low.min(interval.low),
            high: joined.high.max(interval.high),
            ..worst
        }
    }))
}

/// Cuts off the values at the ends that are better than the least that is certain.
fn without_better(interval: Interval, ideal: Ideal, certain: f64) -> Interval {
    let [low, high] = match ideal {
        Ideal::Lowest => [interval.low.max(certain), interval.high],
        Ideal::Highest => [interval.low, interval.high.min(-certain)],
        Ideal::Target(target) => {
            let [below, above] = [target - certain, target + certain];
            let low = if interval.low <= below {
                interval.low
            } else {
                interval.low.max(above)
            };
            let high = if interval.high >= above {
                interval.high
            } else {
                interval.high.min(below)
            };
            [low, high]
        }
    };
    Interval {
        low,
        high,
        ..interval
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn interval(low: f64, high: f64) -> Interval {
        Interval {
            low,
            high,
            center: 0.5 * (low + high),
            standard_error: 1.0,
        }
    }

    fn ends(ideal: Ideal, all: &[[f64; 2]]) -> [f64; 2] {
        let all: Vec<Interval> = all
            .iter()
            .map(|[low, high]| interval(*low, *high))
            .collect();
        let joined = join_worst(&all, ideal).unwrap();
        [joined.low, joined.high]
    }

    /// Values of an error e(n) of n groups, for all four groups and for any three of them.
    fn groups(error: impl Fn(f64) -> f64, floor: f64) -> (Measured, Vec<Option<f64>>) {
        (
            Measured::score(error(4.0), floor),
            vec![Some(error(3.0)); 4],
        )
    }

    #[test]
    fn psnr_is_that_of_the_error_without_noise() {
        let (whole, without) = groups(|count| 0.01 + 0.04 / count, 1e-4);
        let psnr = psnr_interval(&whole, without.into_iter()).unwrap();
        for end in [psnr.low, psnr.center, psnr.high] {
            assert!((end - 20.0).abs() < 1e-9, "{psnr:?}");
        }
    }

    #[test]
    fn psnr_of_an_error_that_may_be_none_is_open_and_its_estimate_the_floor_s() {
        let (whole, _) = groups(|_| 1e-4, 1e-4);
        let without = [1.0, -1.0, 2.0, -2.0].map(|change| Some(1e-4 * (1.0 + change)));
        let psnr = psnr_interval(&whole, without.into_iter()).unwrap();
        assert_eq!(psnr.high, PSNR_LIMIT);
        assert!(
            (psnr.center - 40.0).abs() < 1e-9 && psnr.low < 40.0,
            "{psnr:?}"
        );
        assert!(psnr_interval(&whole, [Some(1.0), None].into_iter()).is_none());
    }

    #[test]
    fn grain_without_noise_is_the_root_of_the_squares_without_it() {
        let (whole, without) = groups(|count: f64| (4e-4 - 4e-4 / count).sqrt(), 1e-3);
        let grain = grain_interval(&whole, without.into_iter()).unwrap();
        for end in [grain.low, grain.center, grain.high] {
            assert!((end - 0.02).abs() < 1e-9, "{grain:?}");
        }
    }

    #[test]
    fn grain_below_none_is_from_none_to_the_floor() {
        let (whole, without) = groups(|_| -0.01, 1e-3);
        let grain = grain_interval(&whole, without.into_iter()).unwrap();
        assert_eq!([grain.low, grain.center, grain.high], [0.0, 0.0, 1e-3]);
    }

    #[test]
    fn a_score_of_still_pixels_reaches_down_by_the_frame_s_own() {
        let metric = Metric::Image(ImageMetric::Flip, Region::Still);
        let interval = Interval {
            center: 0.5,
            ..interval(0.4, 0.6)
        };
        let extended = reach_below(interval, &Measured::score(0.25, 0.0), metric);
        // The half width of 0.1 remains beyond it.
        assert!((extended.low - 0.15).abs() < 1e-12 && extended.high == 0.6);
        assert_eq!(
            reach_below(interval, &Measured::score(0.0, 0.0), metric),
            interval
        );
        let unbiased = Metric::Image(ImageMetric::Mse, Region::Still);
        assert_eq!(
            reach_below(interval, &Measured::score(0.25, 0.0), unbiased),
            interval
        );
    }

    #[test]
    fn the_worst_score_is_at_least_what_is_certain_of_any_object() {
        // The second object is worse than the first one at its best; the third one may be the
        // worst.
        let worst = ends(Ideal::Lowest, &[[0.1, 0.2], [0.3, 0.5], [0.2, 0.6]]);
        assert_eq!(worst, [0.3, 0.6]);
        assert_eq!(
            ends(Ideal::Highest, &[[8.0, 9.0], [5.0, 7.0], [4.0, 8.0]]),
            [4.0, 7.0]
        );
        assert_eq!(join_worst(&[], Ideal::Lowest), None);
    }

    #[test]
    fn the_worst_distance_from_a_target_may_be_on_either_side() {
        let ideal = Ideal::Target(1.0);
        assert_eq!(
            ends(ideal, &[[1.1, 1.2], [1.3, 1.5], [1.0, 1.4]]),
            [1.3, 1.5]
        );
        assert_eq!(ends(ideal, &[[0.5, 0.7], [0.9, 1.1]]), [0.5, 0.7]);
        // Objects on both sides of the target: the worst may be any of them.
        assert_eq!(ends(ideal, &[[0.6, 0.8], [1.3, 1.5]]), [0.6, 1.5]);
    }

    #[test]
    fn the_center_is_of_the_object_that_seems_worst() {
        let all = [interval(0.1, 0.9), interval(0.4, 0.8)];
        assert_eq!(
            join_worst(&all, Ideal::Lowest).unwrap().center,
            0.6000000000000001
        );
    }
}
