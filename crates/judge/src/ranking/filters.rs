//! Ranking of filters by one score, with ties.

use std::cmp::Ordering;

use frame::Alignment;
use measure::{Case, IDENTITY, InputFormat, TWO_SIDED, plain_mean};
use metrics::Metric;
use scene::{FrameRate, SceneId};

use crate::groups::group_by;
use crate::ranking::side_effects::SideEffects;

/// A filter preset in the ranking of its shutter.
#[derive(Clone, Debug, PartialEq)]
pub struct RankedFilter {
    /// `jump_flood:paper`, followed by everything unusual.
    pub name: String,
    /// Name of the filter alone.
    pub filter: String,
    /// Shutter alignment that it is scored against.
    pub alignment: Alignment,
    /// Frame rate of the scenes; none for their files' own.
    pub rate: Option<FrameRate>,
    /// Best and worst rank among the filters of its shutter: 1 plus the number of better filters,
    /// and the number of all filters less the worse ones. None for no blur, which is a reference.
    pub ranks: Option<[usize; 2]>,
    /// True if it is clearly better than no blur; none if that is unknown.
    pub beats_no_blur: Option<bool>,
    /// Mean score over the scenes.
    pub mean: f64,
    /// 95 % CI of the mean over scenes; none on a single scene.
    pub interval: Option<[f64; 2]>,
    /// Number of scenes with a score.
    pub scenes: usize,
    /// Scene with the largest score, and that score.
    pub worst: (SceneId, f64),
    /// Number of measured presets of the filter, including this one; 0 for a reference picture.
    pub presets: usize,
    /// What it changes besides, in the mean.
    pub side_effects: SideEffects,
}

/// Score of one filter preset on one scene; lower is better.
#[derive(Clone, Debug, PartialEq)]
pub struct RankedScore {
    /// Name of the scene.
    pub scene: SceneId,
    /// Name of the filter alone.
    pub filter: String,
    /// `jump_flood:paper`, followed by everything unusual.
    pub name: String,
    /// Shutter alignment that it is scored against.
    pub alignment: Alignment,
    /// The score; for FLIP the estimate against a truth without noise.
    pub value: f64,
    /// Difference that the truth's noise makes.
    pub floor: f64,
    /// What the filter changes besides; nothing in rankings by other scores.
    pub side_effects: SideEffects,
}

/// A filter preset with its scores.
type Entry<'a> = (RankedFilter, Vec<&'a RankedScore>);

/// Explanation of ranks for readers.
pub const RANK_RULE: &str = "Rank 2-4: one filter is clearly better; two cannot be told apart \
                             from this one (95 % CI of the difference; on one scene, the \
                             noise floor).";

/// Upper limit on presets that a summary ranks one by one.
pub const MAX_RANKED: usize = 16;

/// Lists the cases for a summary: scenes at their files' frame rate, or all if no scene is.
pub fn list_summarized(cases: &[Case]) -> Vec<&Case> {
    let as_written = |case: &&Case| case.rate.is_none();
    if cases.iter().any(|case| as_written(&case)) {
        cases.iter().filter(as_written).collect()
    } else {
        cases.iter().collect()
    }
}

/// Ranks filters for a summary: with full input forms, on scenes at their files' frame rate, if the
/// run tried others as well. If there are too many presets, each filter is represented by its best
/// one.
pub fn rank_for_summary(cases: &[Case]) -> Vec<Vec<RankedFilter>> {
    let flips = |is_listed: fn(&Case) -> bool| -> Vec<RankedScore> {
        let cases = list_summarized(cases).into_iter();
        let listed = cases.filter(|case| is_listed(case));
        listed.filter_map(RankedScore::flip_of).collect()
    };
    let full = flips(|case| !case.is_reference && case.input == InputFormat::default());
    let references = flips(|case| case.is_reference);
    rank_best(&full, &references)
}

/// Ranks every preset in every input form, as a table of all of them does.
pub fn rank_presets(cases: &[Case]) -> Vec<Vec<RankedFilter>> {
    let (references, filters): (Vec<&Case>, Vec<&Case>) =
        cases.iter().partition(|case| case.is_reference);
    let [references, filters] = [references, filters].map(|cases| -> Vec<RankedScore> {
        let cases = cases.into_iter();
        cases.filter_map(RankedScore::flip_of).collect()
    });
    rank_by_score(&filters, &references, false)
}

/// Ranks all presets; if they are too many for a summary, only the best of each filter. No blur may
/// be among the references.
pub(crate) fn rank_best(
    scores: &[RankedScore],
    references: &[RankedScore],
) -> Vec<Vec<RankedFilter>> {
    let presets = rank_by_score(scores, references, false);
    let ranked = presets.iter().flatten().filter(|preset| preset.is_ranked());
    if ranked.count() <= MAX_RANKED {
        presets
    } else {
        rank_by_score(scores, references, true)
    }
}

impl RankedScore {
    /// Returns the FLIP of a case; none if nothing moves.
    fn flip_of(case: &Case) -> Option<Self> {
        Some(Self {
            scene: case.scene.clone(),
            filter: case.filter.clone(),
            name: case.name(),
            alignment: case.alignment,
            value: case.estimate(Metric::FLIP)?,
            floor: case.floor(Metric::FLIP)?,
            side_effects: SideEffects::of(|metric| case.estimate(metric)),
        })
    }
}

/// Ranks filters of one shutter and frame rate, best first: one group per shutter and rate. With
/// `best_presets`, each filter is represented by its best preset. No blur, among the scores or the
/// references, has a place in every group and no rank.
///
/// One filter is better than another if its mean is lower and the 95 % CI of the mean difference
/// over their common scenes excludes 0; on a single scene, if the difference exceeds the noise
/// floor. One that ruins what stands still is worse than all that do not. A filter's ranks allow
/// for all filters that are too close to it. Being too close is not transitive, so ranges overlap.
pub(crate) fn rank_by_score(
    scores: &[RankedScore],
    references: &[RankedScore],
    best_presets: bool,
) -> Vec<Vec<RankedFilter>> {
    let shutter = |score: &RankedScore| (score.alignment, score.scene.rate);
    (group_by(scores, |score| shutter(score)).into_iter())
        .map(|group| {
            let references = references.iter();
            let of_shutter = references.filter(|score| shutter(score) == shutter(group[0]));
            let known = group.iter().copied().chain(of_shutter);
            let no_blur: Vec<&RankedScore> =
                known.filter(|score| score.filter == IDENTITY).collect();
            rank_group(group_by(group, |score| &score.name), &no_blur, best_presets)
        })
        .collect()
}

fn rank_group(
    filters: Vec<Vec<&RankedScore>>,
    no_blur: &[&RankedScore],
    best_presets: bool,
) -> Vec<RankedFilter> {
    // No blur has a row in every shutter, from its reference picture where no filter is it.
    let is_measured = |scores: &Vec<&RankedScore>| scores[0].filter == IDENTITY;
    let reference = (!no_blur.is_empty() && !filters.iter().any(is_measured)).then(|| {
        let picture = RankedFilter {
            presets: 0,
            ..summarize(no_blur)
        };
        (picture, no_blur.to_vec())
    });
    let entries = filters
        .into_iter()
        .map(|scores| (summarize(&scores), scores));
    let mut group: Vec<Entry> = entries.chain(reference).collect();
    let ruins_still = |filter: &RankedFilter| filter.side_effects.ruins_still();
    group.sort_by(|(a, _), (b, _)| {
        let by_mean = || a.mean.total_cmp(&b.mean);
        ruins_still(a).cmp(&ruins_still(b)).then_with(by_mean)
    });
    if best_presets {
        group = keep_best_presets(group);
    }
    let is_better = |(filter, scores): &Entry, (other, others): &Entry| match ruins_still(filter)
        .cmp(&ruins_still(other))
    {
        Ordering::Less => true,
        Ordering::Equal => filter.mean < other.mean && !are_tied(scores, others),
        Ordering::Greater => false,
    };
    let ranked = || group.iter().filter(|(filter, _)| filter.filter != IDENTITY);
    let rank = |entry: &Entry| {
        let better = ranked().filter(|other| is_better(other, entry)).count();
        let worse = ranked().filter(|other| is_better(entry, other)).count();
        let is_ranked = entry.0.filter != IDENTITY;
        let is_compared = is_ranked && !no_blur.is_empty();
        RankedFilter {
            ranks: is_ranked.then(|| [1 + better, ranked().count() - worse]),
            beats_no_blur: is_compared.then(|| is_clearly_better(&entry.1, no_blur)),
            ..entry.0.clone()
        }
    };
    group.iter().map(rank).collect()
}

impl RankedFilter {
    /// Returns whether it has a rank: no blur has none.
    pub fn is_ranked(&self) -> bool {
        self.ranks.is_some()
    }

    /// Returns the name that tables show: no blur is a picture, not a filter.
    pub fn shown_name(&self) -> &str {
        if self.is_ranked() {
            &self.name
        } else {
            "no blur"
        }
    }

    /// Formats its rank, or the range of its ranks: `1`, `2-4`, `-`.
    pub fn rank_text(&self) -> String {
        match self.ranks {
            None => "-".to_owned(),
            Some([first, last]) if first == last => first.to_string(),
            Some([first, last]) => format!("{first}-{last}"),
        }
    }

    /// Returns whether no other filter is certainly better.
    pub fn may_be_best(&self) -> bool {
        self.ranks.is_some_and(|[first, _]| first == 1)
    }

    /// Returns whether other filters are too close to it to rank.
    pub fn is_tied(&self) -> bool {
        self.ranks.is_some_and(|[first, last]| first < last)
    }
}

/// Averages the scores of a filter preset.
fn summarize(scores: &[&RankedScore]) -> RankedFilter {
    let values: Vec<f64> = scores.iter().map(|score| score.value).collect();
    let mean = plain_mean(&values, TWO_SIDED);
    let worst = (scores.iter())
        .max_by(|a, b| a.value.total_cmp(&b.value))
        .expect("a filter in a ranking has a score");
    let first = scores[0];
    let side_effects: Vec<SideEffects> = scores.iter().map(|score| score.side_effects).collect();
    RankedFilter {
        side_effects: SideEffects::mean(&side_effects),
        name: first.name.clone(),
        filter: first.filter.clone(),
        alignment: first.alignment,
        rate: first.scene.rate,
        ranks: None,
        beats_no_blur: None,
        mean: mean.mean,
        interval: (values.len() > 1).then_some(mean.interval),
        scenes: values.len(),
        worst: (worst.scene.clone(), worst.value),
        presets: 1,
    }
}

/// Keeps the first preset of every filter of a sorted group.
fn keep_best_presets(group: Vec<Entry>) -> Vec<Entry> {
    let filters = group_by(group, |(filter, _)| filter.filter.clone()).into_iter();
    let best = filters.map(|mut presets| {
        presets[0].0.presets = presets.iter().map(|(filter, _)| filter.presets).sum();
        presets.swap_remove(0)
    });
    best.collect()
}

/// Pairs the scores of two filters on their common scenes: by how much the second is worse, and the
/// larger floor.
fn pair(a: &[&RankedScore], b: &[&RankedScore]) -> (Vec<f64>, Vec<f64>) {
    let pairs = a.iter().filter_map(|score| {
        let other = b.iter().find(|other| other.scene == score.scene)?;
        Some((other.value - score.value, score.floor.max(other.floor)))
    });
    pairs.unzip()
}

fn are_tied(a: &[&RankedScore], b: &[&RankedScore]) -> bool {
    let (differences, floors) = pair(a, b);
    match differences.as_slice() {
        [] => false,
        [difference] => difference.abs() <= floors[0],
        _ => {
            let [low, high] = plain_mean(&differences, TWO_SIDED).interval;
            (low..=high).contains(&0.0)
        }
    }
}

/// Returns whether a filter is better than another in the mean, by its 95 % CI, or on every common
/// scene by more than the noise floor.
fn is_clearly_better(scores: &[&RankedScore], other: &[&RankedScore]) -> bool {
    let (differences, floors) = pair(scores, other);
    let mut both = differences.iter().zip(&floors);
    if differences.is_empty() {
        return false;
    }
    both.all(|(difference, floor)| difference > floor)
        || differences.len() > 1 && plain_mean(&differences, TWO_SIDED).interval[0] > 0.0
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub fn score(name: &str, scene: usize, value: f64, floor: f64) -> RankedScore {
        RankedScore {
            scene: SceneId::new(format!("scene_{scene}"), None),
            filter: name.to_owned(),
            name: name.to_owned(),
            alignment: Alignment::Trailing,
            value,
            floor,
            side_effects: SideEffects::default(),
        }
    }

    #[test]
    fn on_one_scene_the_larger_floor_of_two_filters_ties_them() {
        let scores = [
            score("worst", 0, 0.130, 0.010),
            score("best", 0, 0.100, 0.020),
            score("second", 0, 0.115, 0.010),
        ];
        // 0.015 is within the floor of the best, and beyond those of the other two.
        let [ranking] = &rank_by_score(&scores, &[], false)[..] else {
            panic!("one shutter");
        };
        let ranks: Vec<_> = (ranking.iter())
            .map(|filter| (filter.name.as_str(), filter.rank_text()))
            .collect();
        let expected = [("best", "1-2"), ("second", "1-2"), ("worst", "3")];
        assert_eq!(ranks, expected.map(|(name, rank)| (name, rank.to_owned())));
    }
}
