//! Agreement of scores with people.

use metrics::{Metric, SequenceMetric};
use serde::Serialize;
use suite::{Case, Run, Sequence, TWO_SIDED, Weighted, scene_mean};

use crate::preference_scale::{MIN_PEOPLE, PreferenceScale};
use crate::rank_correlation::rank_correlation;
use crate::session::Session;
use crate::study::Study;

/// Scores of single pictures that are compared with people. Of a sequence they are those of the first frame.
const OF_PICTURES: [Metric; 6] = [
    Metric::FLIP,
    Metric::PSNR,
    Metric::GROWTH,
    Metric::LOSS,
    Metric::Bleed,
    Metric::LABEL,
];
/// Fewer filters than this have no order to speak of.
const MIN_RANKED: usize = 3;

/// How well one score predicts people.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ScoreAgreement {
    /// Score.
    pub score: Metric,
    /// Rank correlation of its mean over the scenes with the scale: 1 if people rank the filters as the score does. None with fewer than
    /// three filters, or where the score does not apply.
    pub correlation: Option<f64>,
    /// 2.5th and 97.5th percentile of the correlation over the resamples. It does not cover the choice of filters and scenes.
    pub correlation_interval: Option<[f64; 2]>,
    /// Share of choices for the filter with the better score on that scene. Choices of neither count half.
    pub predicted: Option<f64>,
    /// 95 % CI of that share over people; none with fewer than five.
    pub predicted_interval: Option<[f64; 2]>,
    /// Number of choices between filters whose scores differ.
    pub choices: usize,
}

/// A score of every filter of one shutter.
struct ScoreTable {
    score: Metric,
    /// How bad each filter is, scene by scene; none where the score does not apply.
    badness: Vec<Vec<Option<f64>>>,
}

/// Compares each score of a run with the answers about one shutter.
pub fn compare_scores(
    run: &Run,
    study: &Study,
    shutter: usize,
    sessions: &[&Session],
    scale: &PreferenceScale,
) -> Vec<ScoreAgreement> {
    let tables = list_tables(run, study, shutter);
    let compare = |table| compare_score(table, shutter, sessions, scale);
    tables.iter().map(compare).collect()
}

fn compare_score(
    table: &ScoreTable,
    shutter: usize,
    sessions: &[&Session],
    scale: &PreferenceScale,
) -> ScoreAgreement {
    let goodness = mean_goodness(table).filter(|means| means.len() >= MIN_RANKED);
    let correlate = |strengths: &Vec<f64>| rank_correlation(strengths, goodness.as_ref()?);
    let correlation = correlate(&scale.strengths);
    let resampled: Vec<f64> = scale.resamples.iter().filter_map(correlate).collect();
    let can_have_interval = correlation.is_some() && scale.intervals.is_some();
    let people: Vec<Weighted> = (sessions.iter())
        .filter_map(|session| predicted(table, shutter, session))
        .collect();
    let mean = (!people.is_empty()).then(|| scene_mean(&people, TWO_SIDED));
    ScoreAgreement {
        score: table.score,
        correlation,
        correlation_interval: (can_have_interval.then(|| percentiles(resampled))).flatten(),
        predicted: mean.map(|mean| mean.mean),
        predicted_interval: (mean.filter(|_| people.len() >= MIN_PEOPLE))
            .map(|mean| mean.interval.map(|end| end.clamp(0.0, 1.0))),
        choices: people.iter().map(|own| own.weight).sum::<f64>() as usize,
    }
}

/// Means over the scenes on which the score applies to every filter, and more is better.
fn mean_goodness(table: &ScoreTable) -> Option<Vec<f64>> {
    let scenes: Vec<Vec<f64>> = (table.badness.iter())
        .filter_map(|scene| scene.iter().copied().collect())
        .collect();
    let count = scenes.len() as f64;
    let filters = scenes.first()?.len();
    let mean = |filter: usize| -scenes.iter().map(|scene| scene[filter]).sum::<f64>() / count;
    Some((0..filters).map(mean).collect())
}

/// The share of a person's choices that a score predicts, weighted by their number.
fn predicted(table: &ScoreTable, shutter: usize, session: &Session) -> Option<Weighted> {
    let (mut agreed, mut count) = (0.0, 0.0);
    for (scene, own) in session.comparisons_by_scene(shutter) {
        let [one, other] = [own.one, own.other].map(|filter| table.badness[scene][filter]);
        let (Some(one), Some(other)) = (one, other) else {
            continue;
        };
        if one != other {
            let is_first = one < other;
            agreed += if is_first { own.share } else { 1.0 - own.share };
            count += 1.0;
        }
    }
    (count > 0.0).then(|| Weighted {
        value: agreed / count,
        weight: count,
    })
}

/// Returns the 2.5th and the 97.5th percentile; none of fewer than 40 values.
fn percentiles(mut values: Vec<f64>) -> Option<[f64; 2]> {
    if values.len() < 40 {
        return None;
    }
    values.sort_by(f64::total_cmp);
    let last = (values.len() - 1) as f64;
    Some([TWO_SIDED, 1.0 - TWO_SIDED].map(|part| values[(part * last).round() as usize]))
}

fn list_tables(run: &Run, study: &Study, shutter: usize) -> Vec<ScoreTable> {
    let own = &study.shutters[shutter];
    let table = |score: Metric, badness: &dyn Fn(&str, &str) -> Option<f64>| {
        let of_scene = |scene: &String| {
            let filters = own.filters.iter();
            filters.map(|filter| badness(scene, filter)).collect()
        };
        ScoreTable {
            score,
            badness: study.scenes.iter().map(of_scene).collect(),
        }
    };
    let sequences = SequenceMetric::ALL.iter().map(|metric| {
        table(Metric::Sequence(*metric), &|scene, filter| {
            let is_wanted = |it: &&Sequence| {
                !it.is_reference
                    && (it.scene == scene && it.alignment == own.alignment)
                    && it.name == filter
            };
            let found = run.sequences.iter().find(is_wanted)?;
            let value = found.scores.get(*metric).value()?;
            Some(metric.row().ideal.badness(value))
        })
    });
    let pictures = OF_PICTURES.iter().map(|metric| {
        table(*metric, &|scene, filter| {
            let is_wanted = |it: &&Case| {
                !it.is_reference
                    && (it.scene == scene && it.alignment == own.alignment)
                    && it.name() == filter
            };
            let case = run.cases.iter().find(is_wanted)?;
            Some(metric.ideal().badness(case.estimate(*metric)?))
        })
    });
    match run.frames.is_one() {
        true => pictures.collect(),
        false => sequences.chain(pictures).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answers::Chosen;
    use crate::design::{Clip, ShownPair};
    use crate::preference_scale::scale_preferences;
    use crate::question::Question;

    /// A person who compares all pairs of four filters on two scenes, and always chooses the smaller number.
    fn person(seed: u64) -> Session {
        let pairs = (0..4).flat_map(|left| (0..4).map(move |right| (left, right)));
        let pairs: Vec<_> = pairs.filter(|(left, right)| left != right).collect();
        let answers = (0..2).flat_map(|scene| {
            pairs.iter().map(move |(left, right)| {
                let trial = ShownPair {
                    shutter: 0,
                    scene,
                    left: Clip::Filter(*left),
                    right: Clip::Filter(*right),
                };
                let chooses_left = left < right;
                (
                    trial,
                    if chooses_left {
                        Chosen::Left
                    } else {
                        Chosen::Right
                    },
                )
            })
        });
        Session {
            path: "a.json".into(),
            question: Question::Truth,
            seed,
            answers: answers.collect(),
        }
    }

    #[test]
    fn a_score_that_ranks_as_people_do_correlates_fully_and_predicts_all() {
        let people: Vec<Session> = (0..6).map(person).collect();
        let all: Vec<&Session> = people.iter().collect();
        let comparisons: Vec<_> = all.iter().map(|own| own.comparisons(0)).collect();
        let scale = scale_preferences(&comparisons, 4, 100).unwrap();
        let compare = |badness: [f64; 4]| {
            let scene: Vec<Option<f64>> = badness.map(Some).into();
            let table = ScoreTable {
                score: Metric::FLIP,
                badness: vec![scene.clone(), scene],
            };
            compare_score(&table, 0, &all, &scale)
        };
        let same = compare([0.1, 0.2, 0.3, 0.4]);
        assert_eq!([same.correlation, same.predicted], [Some(1.0), Some(1.0)]);
        assert_eq!(same.correlation_interval, Some([1.0, 1.0]));
        assert_eq!(same.choices, 6 * 24);
        let opposite = compare([0.4, 0.3, 0.2, 0.1]);
        assert_eq!(opposite.correlation, Some(-1.0));
        assert_eq!(opposite.predicted, Some(0.0));
        // One of six pairs the other way round; 0.8 is the textbook's for one swap of neighbours among four.
        let near = compare([0.2, 0.1, 0.3, 0.4]);
        let far = |found: Option<f64>, expected: f64| (found.unwrap() - expected).abs();
        assert!(far(near.correlation, 0.8) < 1e-12, "{near:?}");
        assert!(far(near.predicted, 5.0 / 6.0) < 1e-12, "{near:?}");
        // A score that is the same for all filters predicts nothing.
        let equal = compare([0.1; 4]);
        let found = (equal.correlation, equal.predicted, equal.choices);
        assert_eq!(found, (None, None, 0));
    }
}
