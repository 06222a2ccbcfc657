//! The count of sub-frames with a picture's error, and its interval.

use super::curve::{Curve, Point};
use super::ladder::{Curves, ErrorKind, Errors, Rung};
use super::{Equivalent, Subframes};
use crate::jackknife;

/// Counts the accumulated sub-frames with the picture's `errors`. `without` holds the picture's errors
/// and the rungs' without each group of samples in turn: of the picture's frame, the truth and the
/// rungs together. `noise` holds the errors that the truth's noise alone makes.
///
/// A count N is possible if the 95 % interval of the difference between the picture's error and the
/// rung's contains 0. So the interval of the count comes from [`jackknife`] intervals of the
/// difference at every rung, and the count itself from their centres. FLIP and label variation are
/// compared in squares, which noise raises by its variance.
///
/// Without groups (a truth of two replicates, an engine's), nothing is known of the difference's
/// noise. Then counts up to [`Subframes::floor`] are taken as certain and others as open.
pub fn equivalent(
    kind: ErrorKind,
    errors: &Errors,
    curves: &Curves,
    noise: &Errors,
    without: &[(Errors, &Curves)],
) -> Equivalent {
    let error = errors.square(kind);
    let difference = |errors: &Errors, curves: &Curves, at: usize| {
        errors.square(kind) - curves.rungs[at].noisy.square(kind)
    };
    let points: Vec<Point> = (curves.rungs.iter().enumerate())
        .map(|(at, rung)| {
            let others = without.iter();
            let others: Vec<f64> = others
                .map(|(errors, curves)| difference(errors, curves, at))
                .collect();
            let whole = difference(errors, curves, at);
            let found = jackknife(whole, &others);
            // The rung's error is the picture's less the difference.
            let [center, low, high] = found.map_or([whole; 3], |interval| {
                [interval.center, interval.low, interval.high]
            });
            Point {
                subframes: f64::from(rung.subframes),
                error: error - center,
                below: high - center,
                above: center - low,
            }
        })
        .collect();
    let exact = |rung: &Rung| Point {
        subframes: f64::from(rung.subframes),
        error: rung.plain.square(kind),
        below: 0.0,
        above: 0.0,
    };
    let plain = Curve(curves.rungs.iter().map(exact).collect());
    let (floor, _) = plain.find(noise.square(kind));
    let curve = Curve(points);
    let (value, range) = curve.find(error);
    if without.len() < 2 {
        return Equivalent::Subframes(Subframes::of_floor(value, floor, range));
    }
    Equivalent::Subframes(Subframes {
        value,
        floor,
        low: curve.lowest(error),
        high: curve.highest(error),
        range,
    })
}

#[cfg(test)]
mod tests {
    use super::super::LadderRange;
    use super::*;

    fn errors(error: f64) -> Errors {
        Errors {
            mse: error,
            flip: error.sqrt(),
            label: error.sqrt(),
        }
    }

    /// Makes rungs with errors 1/N, in squares, with some noise.
    fn curves(noise: f64) -> Curves {
        let rung = |subframes: u32| Rung {
            subframes,
            noisy: errors(1.0 / f64::from(subframes) + noise),
            plain: errors(1.0 / f64::from(subframes)),
        };
        Curves {
            rungs: [1, 2, 4, 8, 16].map(rung).to_vec(),
        }
    }

    /// Counts by every kind of error.
    fn list(
        errors: Errors,
        curves: &Curves,
        noise: Errors,
        without: &[(Errors, &Curves)],
    ) -> [Subframes; 3] {
        [ErrorKind::Mse, ErrorKind::Flip, ErrorKind::Label].map(|kind| {
            match equivalent(kind, &errors, curves, &noise, without) {
                Equivalent::Subframes(count) => count,
                Equivalent::NotApplicable { reason } => panic!("{reason}"),
            }
        })
    }

    #[test]
    fn noise_of_picture_and_rungs_cancels() {
        // Without one of four groups, all noise is a third larger. Each group's own noise is
        // nothing.
        let whole = curves(0.03);
        let others = curves(0.04);
        let without: Vec<(Errors, &Curves)> = [1.0 / 6.0 + 0.04; 4]
            .map(|own| (errors(own), &others))
            .to_vec();
        let own = errors(1.0 / 6.0 + 0.03);
        for count in list(own, &whole, errors(0.1), &without) {
            assert!((5.9..6.1).contains(&count.value), "{count:?}");
            assert_eq!((count.floor - 10.0).round(), 0.0, "{count:?}");
            assert_eq!(count.range, LadderRange::Within);
        }
    }

    #[test]
    fn noise_of_the_picture_alone_is_taken_out_and_widens_the_interval() {
        let whole = curves(0.0);
        // The picture's squared error of 1/6 is raised by 0.03, and by a third more without a
        // group; groups scatter.
        let scatter = [0.01, -0.01, 0.02, -0.02];
        let without: Vec<(Errors, &Curves)> = scatter
            .map(|own| (errors(1.0 / 6.0 + 0.04 + own), &whole))
            .to_vec();
        let own = errors(1.0 / 6.0 + 0.03);
        for count in list(own, &whole, errors(0.001), &without) {
            assert!((5.9..6.1).contains(&count.value), "{count:?}");
            assert!(count.low.is_some_and(|low| low < 5.0), "{count:?}");
            assert!(count.high.is_none_or(|high| high > 8.0), "{count:?}");
        }
    }

    #[test]
    fn without_groups_the_floor_bounds_what_is_certain() {
        let whole = curves(0.0);
        for (own, low, high) in [(0.3, 3.3, Some(3.3)), (0.08, 10.0, None)] {
            for count in list(errors(own), &whole, errors(0.1), &[]) {
                assert!((count.low.unwrap() - low).abs() < 0.2, "{count:?}");
                assert_eq!(count.high.map(|high| (10.0 * high).round() / 10.0), high);
            }
        }
    }
}
