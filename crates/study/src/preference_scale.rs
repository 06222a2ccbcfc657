//! Scale of preferences: strengths from the choices of people, with intervals by resampling.

use statrs::distribution::{ContinuousCDF, StudentsT};
use suite::{Random, TWO_SIDED};

use crate::bradley_terry::fit_strengths;
use crate::paired_counts::{Comparison, PairedCounts};

/// Fewest people to resample; with fewer, their answers are resampled instead.
pub const MIN_PEOPLE: usize = 5;
/// Number of resamples.
pub const RESAMPLES: usize = 1000;
/// Largest part of the resamples that may lack a scale; beyond it there are no intervals.
const MAX_BROKEN: f64 = 0.05;

/// Unit of resampling.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Resampled {
    /// People, each with all answers: intervals hold for people like them.
    People,
    /// Answers of each person: intervals say how these people would answer again, and nothing about others.
    Answers,
}

/// Strengths of things with their resamples.
#[derive(Clone, Debug, PartialEq)]
pub struct PreferenceScale {
    /// Natural logarithms of odds; their mean is 0.
    pub strengths: Vec<f64>,
    /// 95 % confidence intervals; none if there are too few answers: more than one resample in twenty lacks a scale.
    pub intervals: Option<Vec<[f64; 2]>>,
    /// What was resampled.
    pub resampled: Resampled,
    /// Strengths of each resample that has a scale.
    pub resamples: Vec<Vec<f64>>,
}

/// Fits strengths to the comparisons of each person, with Jeffreys' penalty.
///
/// The interval of a strength is its value plus and minus the bootstrap's standard error times Student's t. The error of n resampled
/// people is too small by the root of (n - 1) / n (Efron and Tibshirani, "An introduction to the bootstrap", 1993, section 5.3),
/// which is corrected; t has n - 1 degrees of freedom. None if the comparisons do not connect all things.
pub fn scale_preferences(
    people: &[Vec<Comparison>],
    items: usize,
    resamples: usize,
) -> Option<PreferenceScale> {
    let strengths = fit_strengths(&PairedCounts::new(items, people.iter().flatten()))?;
    let resampled = match people.len() {
        ..MIN_PEOPLE => Resampled::Answers,
        _ => Resampled::People,
    };
    let mut random = Random(1);
    let mut draw = || {
        let mut drawn: Vec<&Comparison> = Vec::new();
        for own in people {
            match resampled {
                Resampled::People => drawn.extend(&people[random.below(people.len())]),
                Resampled::Answers => {
                    drawn.extend(own.iter().map(|_| &own[random.below(own.len())]));
                }
            }
        }
        PairedCounts::new(items, drawn)
    };
    let drawn: Vec<Vec<f64>> = (0..resamples)
        .filter_map(|_| fit_strengths(&draw()))
        .collect();
    let units = match resampled {
        Resampled::People => people.len(),
        Resampled::Answers => people.iter().map(Vec::len).sum(),
    };
    let is_whole = resamples > 0 && drawn.len() as f64 >= (1.0 - MAX_BROKEN) * resamples as f64;
    let intervals = (is_whole && units >= 2).then(|| {
        let units = units as f64;
        let student = StudentsT::new(0.0, 1.0, units - 1.0).expect("two have a degree of freedom");
        let factor = student.inverse_cdf(1.0 - TWO_SIDED) * (units / (units - 1.0)).sqrt();
        let interval = |item: usize| {
            let half = factor * deviation(drawn.iter().map(|values| values[item]));
            [strengths[item] - half, strengths[item] + half]
        };
        (0..items).map(interval).collect()
    });
    Some(PreferenceScale {
        strengths,
        intervals,
        resampled,
        resamples: drawn,
    })
}

/// Standard deviation.
fn deviation(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    let squares: f64 = values.map(|value| (value - mean).powi(2)).sum();
    (squares / count).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bradley_terry::chance;

    /// Strengths that simulated people have on average.
    const KNOWN: [f64; 5] = [-1.2, -0.5, 0.1, 0.4, 1.2];

    fn uniform(random: &mut Random) -> f64 {
        random.below(1 << 30) as f64 / f64::from(1 << 30)
    }

    fn normal(random: &mut Random) -> f64 {
        (0..12).map(|_| uniform(random)).sum::<f64>() - 6.0
    }

    /// Simulates people who judge every pair `times` times. One person's strengths deviate from the known ones by `spread`.
    fn simulate(
        random: &mut Random,
        people: usize,
        times: usize,
        spread: f64,
    ) -> Vec<Vec<Comparison>> {
        let pairs = (0..KNOWN.len()).flat_map(|other| (0..other).map(move |one| (one, other)));
        let pairs: Vec<(usize, usize)> = pairs.collect();
        let mut person = || {
            let own = KNOWN.map(|strength| strength + spread * normal(random));
            let answers = pairs.repeat(times).into_iter().map(|(one, other)| {
                let is_chosen = uniform(random) < chance(own[one] - own[other]);
                let share = f64::from(u8::from(is_chosen));
                Comparison {
                    scene: 0,
                    one,
                    other,
                    share,
                }
            });
            answers.collect()
        };
        (0..people).map(|_| person()).collect()
    }

    /// Returns the share of intervals that contain the strengths of very many such people.
    fn coverage(people: usize, times: usize, spread: f64, studies: usize) -> f64 {
        let mut random = Random(7);
        let expected = match spread {
            0.0 => KNOWN.to_vec(),
            _ => {
                let many = simulate(&mut Random(8), 20_000, 1, spread).concat();
                fit_strengths(&PairedCounts::new(KNOWN.len(), &many)).unwrap()
            }
        };
        let mut held = 0;
        for _ in 0..studies {
            let study = simulate(&mut random, people, times, spread);
            let found = scale_preferences(&study, KNOWN.len(), 200).unwrap();
            let intervals = found.intervals.unwrap();
            held += (intervals.iter().zip(&expected))
                .filter(|([low, high], own)| (low..=high).contains(own))
                .count();
        }
        held as f64 / (studies * KNOWN.len()) as f64
    }

    #[test]
    fn intervals_are_the_scatter_of_resamples_times_student_s_t() {
        // The 97.5th percentile of Student's t with 4 degrees of freedom, and with 29 for the 30 answers.
        for (people, factor) in [
            (5, 2.776_445 * f64::sqrt(5.0 / 4.0)),
            (1, 2.045_230 * f64::sqrt(30.0 / 29.0)),
        ] {
            let times = if people == 1 { 3 } else { 1 };
            let study = simulate(&mut Random(3), people, times, 0.7);
            let found = scale_preferences(&study, KNOWN.len(), 100).unwrap();
            assert!(found.resamples.len() >= 95);
            for (item, [low, high]) in found.intervals.unwrap().into_iter().enumerate() {
                let values: Vec<f64> = found.resamples.iter().map(|own| own[item]).collect();
                let mean = values.iter().sum::<f64>() / values.len() as f64;
                let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
                let half = factor * (squares / values.len() as f64).sqrt();
                assert!((high - found.strengths[item] - half).abs() < 1e-5 * half);
                assert!((found.strengths[item] - low - half).abs() < 1e-5 * half);
            }
        }
    }

    #[test]
    fn about_95_of_100_intervals_of_people_hold_the_known_strengths() {
        let found = coverage(5, 2, 0.7, 75);
        // 300 studies gave 0.963; the standard error of 75 is at most 0.022. Resamples that do not scatter as people do give much
        // less.
        assert!(found >= 0.92, "{found}");
    }

    #[test]
    #[ignore = "prove: one person who answers often, few people, and many, who are alike or not"]
    fn about_95_of_100_intervals_hold_the_known_strengths() {
        // Measured 0.955, 0.963, 0.964 and 0.959.
        for (people, times, spread) in [(1, 3, 0.0), (5, 2, 0.7), (10, 1, 0.0), (20, 2, 0.7)] {
            let found = coverage(people, times, spread, 300);
            // The standard error of 300 studies is at most 0.013.
            assert!((0.925..=0.985).contains(&found), "{people} people: {found}");
        }
    }

    #[test]
    fn one_answer_has_no_interval() {
        let compare = |one, other| Comparison {
            scene: 0,
            one,
            other,
            share: 1.0,
        };
        let comparison = compare(0, 1);
        let found = scale_preferences(&[vec![comparison]], 2, 100).unwrap();
        assert_eq!(found.intervals, None);
        assert_eq!(found.resampled, Resampled::Answers);
        // Only one person compared two of the three things: some resamples lack that person.
        let mut people = vec![vec![comparison]; 9];
        people.push(vec![compare(1, 2)]);
        let found = scale_preferences(&people, 3, 100).unwrap();
        assert_eq!(found.intervals, None);
        people.truncate(9);
        assert_eq!(scale_preferences(&people, 3, 100), None);
    }
}
