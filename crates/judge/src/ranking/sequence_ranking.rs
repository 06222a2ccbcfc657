//! Ranking of the filters of sequences, with ties.

use std::collections::HashMap;

use measure::{Case, FilterId, InputFormat, Run, SceneMean, Sequence, TWO_SIDED, plain_mean};
use metrics::{Measured, PERFECT_JOD, SequenceMetric};
use scene::SceneId;

use crate::ranking::filters::{RankedFilter, RankedScore, rank_best, rank_by_score};
use crate::ranking::side_effects::SideEffects;

/// The score that ranks sequences: it counts errors of single frames and of their changes together.
/// Scores of changes alone would favour a filter that flickers little around a wrong picture.
pub const RANKED_BY: SequenceMetric = SequenceMetric::Jod;

/// A filter preset in the ranking of sequences of its shutter.
#[derive(Clone, Debug, PartialEq)]
pub struct RankedSequence {
    /// Rank by [`RANKED_BY`], and the mean of that score over the scenes; its worst scene has the
    /// lowest score.
    pub ranked: RankedFilter,
    /// Mean of every displayed score over the scenes; none if no scene has it.
    pub means: Vec<(SequenceMetric, Option<SceneMean>)>,
}

/// Ranks the filters of a run's sequences, one group per shutter, with full input forms if the run
/// tried others as well. If there are too many presets for a summary, each filter is represented by
/// its best one. Leaves out filters without the deciding score, which have no rank.
pub fn rank_sequences(run: &Run) -> Vec<Vec<RankedSequence>> {
    let is_full = |_: &Sequence, case: &Case| case.input == InputFormat::default();
    rank(
        &list_filters(run, is_full),
        &list_references(run),
        rank_best,
    )
}

/// Ranks the sequences of one scene, every preset in every input form.
pub fn rank_sequences_on(run: &Run, scene: &SceneId) -> Vec<Vec<RankedSequence>> {
    let is_of_scene = |sequence: &Sequence, _: &Case| sequence.scene == *scene;
    let mut references = list_references(run);
    references.retain(|reference| reference.scene == *scene);
    rank(
        &list_filters(run, is_of_scene),
        &references,
        |losses, references| rank_by_score(losses, references, false),
    )
}

/// Lists the sequences of some filters, each with its filter's name.
fn list_filters(run: &Run, is_listed: impl Fn(&Sequence, &Case) -> bool) -> Vec<(&Sequence, &str)> {
    let filters = run.cases.iter().filter(|case| !case.is_reference);
    let cases: HashMap<(&SceneId, FilterId), &Case> = filters
        .map(|case| ((&case.scene, case.filter_id()), case))
        .collect();
    let sequences = run
        .sequences
        .iter()
        .filter(|sequence| !sequence.is_reference);
    let listed = sequences.filter_map(|sequence| {
        let case = cases.get(&(&sequence.scene, sequence.filter.clone()))?;
        is_listed(sequence, case).then_some((sequence, case.filter.as_str()))
    });
    listed.collect()
}

/// Lists the sequences of reference pictures.
fn list_references(run: &Run) -> Vec<&Sequence> {
    let sequences = run.sequences.iter();
    sequences.filter(|sequence| sequence.is_reference).collect()
}

fn rank(
    filters: &[(&Sequence, &str)],
    references: &[&Sequence],
    rank: impl Fn(&[RankedScore], &[RankedScore]) -> Vec<Vec<RankedFilter>>,
) -> Vec<Vec<RankedSequence>> {
    let losses = filters.iter();
    let losses = losses.filter_map(|(sequence, filter)| loss_of(sequence, filter));
    let losses: Vec<RankedScore> = losses.collect();
    let lost = references.iter();
    let lost = lost.filter_map(|reference| loss_of(reference, &reference.name));
    let lost: Vec<RankedScore> = lost.collect();
    let with_means = |lost: RankedFilter| {
        let filters = filters.iter().map(|(sequence, _)| *sequence);
        let sequences: Vec<&Sequence> = (filters.chain(references.iter().copied()))
            .filter(|sequence| sequence.name == lost.name && sequence.alignment == lost.alignment)
            .filter(|sequence| sequence.scene.rate == lost.rate)
            .collect();
        RankedSequence {
            means: SequenceMetric::ALL
                .map(|metric| (metric, mean(&sequences, metric)))
                .to_vec(),
            ranked: as_quality(lost),
        }
    };
    (rank(&losses, &lost).into_iter())
        .map(|group| group.into_iter().map(with_means).collect())
        .collect()
}

/// Computes a sequence's JOD below perfect, and the JOD that the truth's noise may account for.
fn loss_of(sequence: &Sequence, filter: &str) -> Option<RankedScore> {
    let Measured::Score(score) = sequence.scores.get(RANKED_BY) else {
        return None;
    };
    Some(RankedScore {
        scene: sequence.scene.clone(),
        filter: filter.to_owned(),
        name: sequence.name.clone(),
        alignment: sequence.alignment,
        value: PERFECT_JOD - score.value,
        floor: PERFECT_JOD - score.floor,
        side_effects: SideEffects::default(),
    })
}

/// Converts lost JOD to remaining JOD.
fn as_quality(lost: RankedFilter) -> RankedFilter {
    let left = |lost: f64| PERFECT_JOD - lost;
    RankedFilter {
        mean: left(lost.mean),
        interval: lost.interval.map(|[low, high]| [left(high), left(low)]),
        worst: (lost.worst.0, left(lost.worst.1)),
        ..lost
    }
}

fn mean(sequences: &[&Sequence], metric: SequenceMetric) -> Option<SceneMean> {
    let values: Vec<f64> = (sequences.iter())
        .filter_map(|sequence| Some(metric.shown(sequence.scores.get(metric).value()?)))
        .collect();
    (!values.is_empty()).then(|| plain_mean(&values, TWO_SIDED))
}
