//! Order of a session: which pairs are shown, and on which side. The page's `ask_session.js` draws the same; a test compares both.

use suite::Random;

use crate::answers::Chosen;
use crate::paired_counts::Comparison;
use crate::question::Question;
use crate::study::{Study, round_size};

/// Number of pairs per check.
const PAIRS_PER_CHECK: usize = 8;
/// Fewest checks of a session.
const MIN_CHECKS: usize = 2;

/// One of two clips that are shown side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clip {
    /// The clip of the filter of this number among those of its shutter.
    Filter(usize),
    /// The truth.
    Truth,
    /// The frames as they are, without blur.
    Sharp,
}

/// Two clips of one scene side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShownPair {
    /// Number of the shutter.
    pub shutter: usize,
    /// Number of the scene.
    pub scene: usize,
    /// Clip on the left.
    pub left: Clip,
    /// Clip on the right.
    pub right: Clip,
}

/// Draws the trials of a session from its seed.
///
/// The filters of a shutter form a circle in random order, one circle per scene. A round compares each filter with the one at a
/// certain distance, so that each is shown equally often; a round of distance 1 connects them all (David, "The structure of cyclic
/// paired-comparison designs", Journal of the Australian Mathematical Society 3, 1963, 117-127). Rounds of all distances cover all
/// pairs. A session has as many rounds as its limit allows, near distances first, scenes in random order. Checks are added to these:
/// the same clip twice; and if the question is about the truth, the truth and the sharp frame.
pub fn draw_session(study: &Study, question: Question, seed: u64) -> Vec<ShownPair> {
    let mut random = Random(seed);
    let mut circles: Vec<Vec<Vec<usize>>> = Vec::new();
    for own in &study.shutters {
        let scenes = study.scenes.iter();
        let circle = |_| draw_order(own.filters.len(), &mut random);
        circles.push(scenes.map(circle).collect());
    }
    let mut trials = Vec::new();
    for [distance, scene, shutter] in draw_rounds(study, &mut random) {
        let circle = &circles[shutter][scene];
        for place in 0..round_size(circle.len(), distance) {
            trials.push(ShownPair {
                shutter,
                scene,
                left: Clip::Filter(circle[place]),
                right: Clip::Filter(circle[(place + distance) % circle.len()]),
            });
        }
    }
    let checks = trials.len().div_ceil(PAIRS_PER_CHECK).max(MIN_CHECKS);
    for check in 0..checks {
        trials.push(draw_check(study, question, check, &mut random));
    }
    shuffle(&mut trials, &mut random);
    for trial in &mut trials {
        if random.below(2) == 1 {
            (trial.left, trial.right) = (trial.right, trial.left);
        }
    }
    trials
}

impl ShownPair {
    /// Returns whether the trial is a check, which has a right answer.
    pub fn is_check(&self) -> bool {
        self.left == self.right || [self.left, self.right].contains(&Clip::Truth)
    }

    /// Converts a choice to a comparison; none for a check.
    pub(crate) fn comparison(&self, choice: Chosen) -> Option<Comparison> {
        let (Clip::Filter(left), Clip::Filter(right)) = (self.left, self.right) else {
            return None;
        };
        (left != right).then(|| Comparison {
            scene: self.scene,
            one: left.min(right),
            other: left.max(right),
            share: match choice {
                Chosen::Neither => 0.5,
                _ if (choice == Chosen::Left) == (left < right) => 1.0,
                _ => 0.0,
            },
        })
    }
}

/// Draws the rounds of a session: distance, scene and shutter. Every shutter has at least one.
fn draw_rounds(study: &Study, random: &mut Random) -> Vec<[usize; 3]> {
    let counts: Vec<usize> = study.shutters.iter().map(|own| own.filters.len()).collect();
    let farthest = counts.iter().max().map_or(0, |count| count / 2);
    let (mut rounds, mut pairs) = (Vec::new(), 0);
    for distance in 1..=farthest {
        for scene in draw_order(study.scenes.len(), random) {
            for (shutter, count) in counts.iter().enumerate() {
                if 2 * distance > *count {
                    continue;
                }
                pairs += round_size(*count, distance);
                if pairs > study.most_pairs {
                    return rounds;
                }
                rounds.push([distance, scene, shutter]);
            }
        }
    }
    rounds
}

/// Draws a check. Whether the truth looks better than the sharp frame is a matter of taste, so no check asks for that.
fn draw_check(study: &Study, question: Question, index: usize, random: &mut Random) -> ShownPair {
    let shutter = random.below(study.shutters.len());
    let own = &study.shutters[shutter];
    let (scene, left, right) = if question == Question::Truth && index.is_multiple_of(2) {
        let scene = own.blurred_scenes[random.below(own.blurred_scenes.len())];
        (scene, Clip::Truth, Clip::Sharp)
    } else {
        let scene = random.below(study.scenes.len());
        let clip = Clip::Filter(random.below(own.filters.len()));
        (scene, clip, clip)
    };
    ShownPair {
        shutter,
        scene,
        left,
        right,
    }
}

/// Draws an order of the numbers below `count`.
fn draw_order(count: usize, random: &mut Random) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    shuffle(&mut order, random);
    order
}

/// Shuffles a list (Fisher and Yates; Knuth, "Seminumerical algorithms", algorithm P).
fn shuffle<T>(list: &mut [T], random: &mut Random) {
    for last in (1..list.len()).rev() {
        list.swap(last, random.below(last + 1));
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use frame::Alignment;
    use tracer::SceneId;

    use super::*;
    use crate::paired_counts::PairedCounts;
    use crate::study::StudyShutter;

    fn study(filters: &[usize], scenes: usize, most_pairs: usize) -> Study {
        let shutter = |(index, count): (usize, &usize)| StudyShutter {
            alignment: [Alignment::Centred, Alignment::Trailing][index],
            filters: (0..*count).map(|own| format!("filter:{own}")).collect(),
            truth_hashes: vec![vec![String::new()]; scenes],
            blurred_scenes: vec![scenes - 1],
        };
        let scene = |index| SceneId::new(format!("scene_{index}"), None);
        Study {
            width: 64,
            height: 32,
            frames: Default::default(),
            scenes: (0..scenes).map(scene).collect(),
            shutters: filters.iter().enumerate().map(shutter).collect(),
            most_pairs,
            pictures: String::new(),
        }
    }

    /// Lists the comparisons of a shutter, ignoring sides.
    fn comparisons(trials: &[ShownPair], shutter: usize) -> Vec<Comparison> {
        let own = trials.iter().filter(|own| own.shutter == shutter);
        own.filter_map(|own| own.comparison(Chosen::Left)).collect()
    }

    #[test]
    fn every_pair_is_shown_once_on_every_scene_if_the_limit_allows_it() {
        for filters in [[2, 3], [4, 5], [6, 7]] {
            let study = study(&filters, 3, 1000);
            for seed in 0..20 {
                let trials = draw_session(&study, Question::Truth, seed);
                for (shutter, count) in filters.iter().enumerate() {
                    let found = comparisons(&trials, shutter);
                    let pairs = found.iter().map(|own| (own.scene, own.one, own.other));
                    assert_eq!(found.len(), 3 * count * (count - 1) / 2);
                    assert_eq!(pairs.collect::<HashSet<_>>().len(), found.len());
                }
            }
        }
    }

    #[test]
    fn a_short_session_shows_every_filter_equally_often_and_connects_all() {
        let mut firsts_on_the_left = Vec::new();
        for seed in 0..50 {
            // 3 rounds of both, one more of both, and one more of the first. The next one has 2 pairs: a limit 1 higher admits it.
            for (limit, pairs) in [(60, 3 * (9 + 4) + (9 + 2) + 9), (61, 61)] {
                let trials = draw_session(&study(&[9, 4], 3, limit), Question::Better, seed);
                let [one, other] = [0, 1].map(|shutter| comparisons(&trials, shutter));
                assert_eq!(one.len() + other.len(), pairs);
                for (count, own) in [(9, &one), (4, &other)] {
                    let counts = PairedCounts::new(count, own);
                    assert_eq!(counts.connected().len(), 1);
                    let compared = |item| counts.totals(item)[1];
                    assert!((0..count).all(|item| compared(item) == compared(0)));
                }
                firsts_on_the_left.extend([one, other].concat().iter().map(|own| own.share));
            }
        }
        let share = firsts_on_the_left.iter().sum::<f64>() / firsts_on_the_left.len() as f64;
        // 4 sigma of some 2,500 pairs, each drawn under two limits.
        assert!((share - 0.5).abs() < 0.04, "{share}");
    }

    #[test]
    fn checks_show_the_truth_and_the_sharp_frame_only_if_the_truth_is_asked_for() {
        let mut truths_on_the_left = 0;
        for seed in 0..100 {
            for (question, expected) in [(Question::Truth, [1, 1]), (Question::Better, [2, 0])] {
                let trials = draw_session(&study(&[4], 2, 1000), question, seed);
                let count =
                    |is_counted: fn(&&ShownPair) -> bool| trials.iter().filter(is_counted).count();
                let same = count(|own| own.left == own.right);
                // The blurred scene.
                let [left, right] = [
                    count(|own| (own.scene, own.left, own.right) == (1, Clip::Truth, Clip::Sharp)),
                    count(|own| (own.scene, own.left, own.right) == (1, Clip::Sharp, Clip::Truth)),
                ];
                assert_eq!([same, left + right], expected);
                truths_on_the_left += left;
            }
        }
        // 4 sigma of 100 checks.
        assert!((30..=70).contains(&truths_on_the_left));
    }
}
