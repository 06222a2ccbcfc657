//! Agreement of scores with people.

use frame::Alignment;
use metrics::{Metric, SequenceMetric};
use serde::Serialize;
use suite::{Run, TWO_SIDED, Weighted, scene_mean};
use tracer::SceneId;

use crate::paired_counts::Comparison;
use crate::preference_scale::{MIN_PEOPLE, PreferenceScale};
use crate::rank_correlation::rank_correlation;
use crate::study::Study;

/// Scores of single pictures that are compared with people; for a sequence, scores of its first frame.
const OF_PICTURES: [Metric; 6] = [
    Metric::FLIP,
    Metric::PSNR,
    Metric::GROWTH,
    Metric::LOSS,
    Metric::Bleed,
    Metric::LABEL,
];
/// Fewest filters that can be ranked.
const MIN_RANKED: usize = 3;

/// How well one score predicts people.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ScoreAgreement {
    /// Score.
    pub score: Metric,
    /// Rank correlation of its mean over the scenes with the scale: 1 if people rank the filters as the score does. None with fewer than
    /// three filters, or if the score does not apply.
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
    /// How bad each filter is, scene by scene; none if the score does not apply.
    badness: Vec<Vec<Option<f64>>>,
}

/// Compares each score of a run with the answers about one shutter.
pub fn compare_scores(
    run: &Run,
    study: &Study,
    shutter: usize,
    people: &[Vec<Comparison>],
    scale: &PreferenceScale,
) -> Vec<ScoreAgreement> {
    let tables = list_tables(run, study, shutter).into_iter();
    let compare = |table| compare_score(&table, people, scale);
    tables.map(compare).collect()
}

fn compare_score(
    table: &ScoreTable,
    people: &[Vec<Comparison>],
    scale: &PreferenceScale,
) -> ScoreAgreement {
    let goodness = mean_goodness(table).filter(|means| means.len() >= MIN_RANKED);
    let correlate = |strengths: &Vec<f64>| rank_correlation(strengths, goodness.as_ref()?);
    let correlation = correlate(&scale.strengths);
    let resampled: Vec<f64> = scale.resamples.iter().filter_map(correlate).collect();
    let can_have_interval = correlation.is_some() && scale.intervals.is_some();
    let people: Vec<Weighted> = (people.iter())
        .filter_map(|own| predicted(table, own))
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

/// Averages a score over the scenes on which it applies to every filter; more is better.
fn mean_goodness(table: &ScoreTable) -> Option<Vec<f64>> {
    let scenes: Vec<Vec<f64>> = (table.badness.iter())
        .filter_map(|scene| scene.iter().copied().collect())
        .collect();
    let count = scenes.len() as f64;
    let filters = scenes.first()?.len();
    let mean = |filter: usize| -scenes.iter().map(|scene| scene[filter]).sum::<f64>() / count;
    Some((0..filters).map(mean).collect())
}

/// Returns the share of a person's choices that a score predicts, weighted by their number.
fn predicted(table: &ScoreTable, choices: &[Comparison]) -> Option<Weighted> {
    let (mut agreed, mut count) = (0.0, 0.0);
    for own in choices {
        let [one, other] = [own.one, own.other].map(|filter| table.badness[own.scene][filter]);
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

/// Returns the 2.5th and the 97.5th percentile; none for fewer than 40 values.
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
    let table = |score: Metric| {
        let of_scene = |scene: &SceneId| {
            let filters = own.filters.iter();
            let badness = |filter| find_badness(run, score, scene, own.alignment, filter);
            filters.map(badness).collect()
        };
        ScoreTable {
            score,
            badness: study.scenes.iter().map(of_scene).collect(),
        }
    };
    let sequences = SequenceMetric::ALL.iter().copied().map(Metric::Sequence);
    match run.frames.is_one() {
        true => OF_PICTURES.map(table).into(),
        false => sequences.chain(OF_PICTURES).map(table).collect(),
    }
}

/// Returns how bad a filter is by a score; none if the score does not apply, or the run has none.
fn find_badness(
    run: &Run,
    score: Metric,
    scene: &SceneId,
    alignment: Alignment,
    filter: &String,
) -> Option<f64> {
    let wanted = (false, scene, alignment);
    let value = match score {
        Metric::Sequence(metric) => {
            let mut all = run.sequences.iter();
            let found = all.find(|own| {
                (own.is_reference, &own.scene, own.alignment) == wanted && own.name == *filter
            });
            found?.scores.get(metric).value()
        }
        _ => {
            let mut all = run.cases.iter();
            let found = all.find(|own| {
                (own.is_reference, &own.scene, own.alignment) == wanted && own.name() == *filter
            });
            found?.estimate(score)
        }
    };
    Some(score.ideal().badness(value?))
}

#[test]
fn a_score_that_ranks_as_people_do_correlates_fully_and_predicts_all() {
    // Six people compare all pairs of four filters on two scenes, and always choose the smaller number.
    let pairs = (0..4).flat_map(|other| (0..other).map(move |one| (one, other)));
    let choices = pairs.flat_map(|(one, other)| {
        [0, 1].map(|scene| Comparison {
            scene,
            one,
            other,
            share: 1.0,
        })
    });
    let people = vec![choices.collect::<Vec<_>>(); 6];
    let scale = crate::preference_scale::scale_preferences(&people, 4, 100).unwrap();
    let compare = |badness: [f64; 4]| {
        let table = ScoreTable {
            score: Metric::FLIP,
            badness: vec![badness.map(Some).into(); 2],
        };
        compare_score(&table, &people, &scale)
    };
    let same = compare([0.1, 0.2, 0.3, 0.4]);
    assert_eq!([same.correlation, same.predicted], [Some(1.0), Some(1.0)]);
    assert_eq!(same.correlation_interval, Some([1.0, 1.0]));
    assert_eq!(same.choices, 6 * 12);
    // One of six pairs in the opposite order.
    let near = compare([0.2, 0.1, 0.3, 0.4]).predicted.unwrap();
    assert!((near - 5.0 / 6.0).abs() < 1e-12, "{near}");
    // A score that is the same for all filters predicts nothing.
    let equal = compare([0.1; 4]);
    let found = (equal.correlation, equal.predicted, equal.choices);
    assert_eq!(found, (None, None, 0));
}
