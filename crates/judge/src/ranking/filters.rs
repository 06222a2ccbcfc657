//! Ranking of filters by one score, with ties.

use frame::Alignment;
use metrics::Metric;
use suite::{Case, InputFormat, TWO_SIDED, plain_mean};
use tracer::{FrameRate, SceneId};

/// A filter preset in the ranking of its shutter.
#[derive(Clone, Debug, PartialEq)]
pub struct RankedFilter {
    /// `jump_flood:paper`, followed by what is not as usual.
    pub name: String,
    /// Name of the filter alone.
    pub filter: String,
    /// Shutter alignment that it is scored against.
    pub alignment: Alignment,
    /// Frame rate of the scenes; none for that of their files.
    pub rate: Option<FrameRate>,
    /// Best and worst rank among the filters of its shutter: the first is 1 plus the number of filters that are better, the second the
    /// number of all filters less those that are worse.
    pub ranks: [usize; 2],
    /// Mean score over the scenes.
    pub mean: f64,
    /// 95 % CI of the mean over scenes; none on a single scene.
    pub interval: Option<[f64; 2]>,
    /// Number of scenes that have a score.
    pub scenes: usize,
    /// Scene with the largest score, and that score.
    pub worst: (SceneId, f64),
    /// Number of ranked presets of the filter, this one included.
    pub presets: usize,
}

/// Score of one filter preset on one scene, of which lower is better.
#[derive(Clone, Debug, PartialEq)]
pub struct RankedScore {
    /// Name of the scene.
    pub scene: SceneId,
    /// Name of the filter alone.
    pub filter: String,
    /// `jump_flood:paper`, followed by what is not as usual.
    pub name: String,
    /// Shutter alignment that it is scored against.
    pub alignment: Alignment,
    /// The score; of FLIP the estimate against a truth without noise.
    pub value: f64,
    /// Difference that the truth's noise makes.
    pub floor: f64,
}

struct Entry {
    ranked: RankedFilter,
    scores: Vec<RankedScore>,
}

/// What ranks say, for readers.
pub const RANK_RULE: &str = "Rank 2-4: one filter is better, two are too close to tell apart, the others are worse, by the 95 % CI of \
                             the difference (on one scene, the noise floor).";

/// Upper limit on presets that a summary ranks one by one.
pub const MAX_RANKED: usize = 16;

/// Lists the cases that a summary ranks: those of scenes at the frame rate of their files, or all where no scene is.
pub fn list_summarized(cases: &[Case]) -> Vec<&Case> {
    let as_written = |case: &&Case| case.rate.is_none();
    match cases.iter().any(|case| as_written(&case)) {
        true => cases.iter().filter(as_written).collect(),
        false => cases.iter().collect(),
    }
}

/// Ranks filters for a summary, with the full form of their input, on scenes at the frame rate of their files, where the run tried
/// others as well. Where the presets are too many for it, the best preset of each filter stands for the filter.
pub fn rank_for_summary(cases: &[Case]) -> Vec<Vec<RankedFilter>> {
    let full: Vec<RankedScore> = (list_summarized(cases).into_iter())
        .filter(|case| !case.is_reference && case.input == InputFormat::default())
        .filter_map(RankedScore::flip_of)
        .collect();
    let presets = rank_by_score(&full, false);
    match presets.iter().map(Vec::len).sum() {
        ..=MAX_RANKED => presets,
        _ => rank_by_score(&full, true),
    }
}

impl RankedScore {
    /// The FLIP of a case; none where nothing moves.
    fn flip_of(case: &Case) -> Option<Self> {
        Some(Self {
            scene: case.scene.clone(),
            filter: case.filter.clone(),
            name: case.name(),
            alignment: case.alignment,
            value: case.estimate(Metric::FLIP)?,
            floor: case.floor(Metric::FLIP)?,
        })
    }
}

/// Ranks filters of one shutter and frame rate among each other, the best first: one group per shutter and rate. With `best_presets`, the best preset stands
/// for its filter.
///
/// One filter is better than another if its mean is lower and the 95 % CI of the mean difference over their common scenes excludes 0;
/// on a single scene, if the difference exceeds the noise floor. A filter's ranks leave room for all filters that cannot be told from
/// it. That two filters are too close to tell apart is not transitive, so that ranges overlap.
pub(crate) fn rank_by_score(scores: &[RankedScore], best_presets: bool) -> Vec<Vec<RankedFilter>> {
    let mut groups: Vec<Vec<Entry>> = Vec::new();
    for score in scores {
        let rate = score.scene.rate;
        let group = (groups.iter()).position(|group| {
            let ranked = &group[0].ranked;
            ranked.alignment == score.alignment && ranked.rate == rate
        });
        let group = group.unwrap_or_else(|| {
            groups.push(Vec::new());
            groups.len() - 1
        });
        let entry = (groups[group].iter_mut()).find(|entry| entry.ranked.name == score.name);
        match entry {
            Some(entry) => entry.scores.push(score.clone()),
            None => groups[group].push(new_entry(score)),
        }
    }
    (groups.into_iter())
        .map(|group| rank_group(group, best_presets))
        .collect()
}

fn new_entry(score: &RankedScore) -> Entry {
    Entry {
        ranked: RankedFilter {
            name: score.name.clone(),
            filter: score.filter.clone(),
            alignment: score.alignment,
            rate: score.scene.rate,
            ranks: [1, 1],
            mean: 0.0,
            interval: None,
            scenes: 0,
            worst: (SceneId::default(), 0.0),
            presets: 1,
        },
        scores: vec![score.clone()],
    }
}

fn rank_group(mut group: Vec<Entry>, best_presets: bool) -> Vec<RankedFilter> {
    for entry in &mut group {
        summarize(entry);
    }
    group.sort_by(|a, b| a.ranked.mean.total_cmp(&b.ranked.mean));
    if best_presets {
        group = keep_best_presets(group);
    }
    let is_better =
        |own: &Entry, other: &Entry| own.ranked.mean < other.ranked.mean && !are_tied(own, other);
    let ranks: Vec<[usize; 2]> = (group.iter())
        .map(|own| {
            let better = group.iter().filter(|other| is_better(other, own));
            let worse = group.iter().filter(|other| is_better(own, other));
            [1 + better.count(), group.len() - worse.count()]
        })
        .collect();
    (group.into_iter().zip(ranks))
        .map(|(entry, ranks)| RankedFilter {
            ranks,
            ..entry.ranked
        })
        .collect()
}

impl RankedFilter {
    /// Writes its rank, or the range of its ranks: `1`, `2-4`.
    pub fn rank_text(&self) -> String {
        match self.ranks {
            [first, last] if first == last => first.to_string(),
            [first, last] => format!("{first}-{last}"),
        }
    }

    /// Tells whether other filters are too close to it to tell apart.
    pub fn is_tied(&self) -> bool {
        self.ranks[0] < self.ranks[1]
    }
}

fn summarize(entry: &mut Entry) {
    let values: Vec<f64> = entry.scores.iter().map(|score| score.value).collect();
    let mean = plain_mean(&values, TWO_SIDED);
    let worst = (entry.scores.iter())
        .max_by(|a, b| a.value.total_cmp(&b.value))
        .expect("an entry has a score");
    entry.ranked.mean = mean.mean;
    entry.ranked.interval = (values.len() > 1).then_some(mean.interval);
    entry.ranked.scenes = values.len();
    entry.ranked.worst = (worst.scene.clone(), worst.value);
}

/// Keeps the first preset of every filter of a sorted group.
fn keep_best_presets(group: Vec<Entry>) -> Vec<Entry> {
    let mut best: Vec<Entry> = Vec::new();
    for entry in group {
        let known = (best.iter_mut()).find(|other| other.ranked.filter == entry.ranked.filter);
        match known {
            Some(other) => other.ranked.presets += 1,
            None => best.push(entry),
        }
    }
    best
}

fn are_tied(a: &Entry, b: &Entry) -> bool {
    let pairs = a.scores.iter().filter_map(|score| {
        let other = b.scores.iter().find(|other| other.scene == score.scene)?;
        Some((other.value - score.value, score.floor.max(other.floor)))
    });
    let (differences, floors): (Vec<f64>, Vec<f64>) = pairs.unzip();
    match differences.as_slice() {
        [] => false,
        [difference] => difference.abs() <= floors[0],
        _ => {
            let [low, high] = plain_mean(&differences, TWO_SIDED).interval;
            (low..=high).contains(&0.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_leave_room_for_the_filters_that_cannot_be_told_apart() {
        let scores: Vec<RankedScore> = [
            ("a", [0.10, 0.20, 0.30]),
            // Better than c on every scene by about as much, and not told from a.
            ("b", [0.15, 0.21, 0.28]),
            ("c", [0.17, 0.23, 0.302]),
            // Worse than all on every scene, by about as much.
            ("d", [0.47, 0.53, 0.602]),
        ]
        .into_iter()
        .flat_map(|(name, values)| {
            (["fan", "flag", "creep"].into_iter().zip(values)).map(move |(scene, value)| {
                RankedScore {
                    scene: SceneId::new(scene, None),
                    ..score(name, value)
                }
            })
        })
        .collect();
        let ranked = &rank_by_score(&scores, false)[0];
        let ranks: Vec<_> = (ranked.iter())
            .map(|own| (own.filter.as_str(), own.rank_text()))
            .collect();
        // a cannot be told from b and c, so it may be any of the three. b is better than c, and so neither first and last.
        let due = [("a", "1-3"), ("b", "1-2"), ("c", "2-3"), ("d", "4")];
        assert_eq!(ranks, due.map(|(name, rank)| (name, rank.to_owned())));
    }

    fn score(name: &str, value: f64) -> RankedScore {
        RankedScore {
            scene: SceneId::new("fan", None),
            filter: name.to_owned(),
            name: format!("{name}:default"),
            alignment: Alignment::Centred,
            value,
            floor: 0.01,
        }
    }

    #[test]
    fn on_one_scene_filters_tie_within_the_noise_floor() {
        let scores = [score("a", 0.1), score("b", 0.109), score("c", 0.111)];
        let ranks = |scores: &[RankedScore]| -> Vec<[usize; 2]> {
            let ranked = rank_by_score(scores, false);
            ranked[0].iter().map(|own| own.ranks).collect()
        };
        assert_eq!(ranks(&scores[..2]), [[1, 2], [1, 2]]);
        assert_eq!(
            ranks(&[scores[0].clone(), scores[2].clone()]),
            [[1, 1], [2, 2]]
        );
    }
}
