//! Agreement between people.

use std::collections::HashMap;

use serde::Serialize;

use crate::session::Session;

/// How often two people chose alike.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PeopleAgreement {
    /// Share of the pairs of answers that are alike. Choices of neither are half like any other. Coins give 1/2, and u, the coefficient
    /// of agreement of Kendall and Babington Smith ("On the method of paired comparisons", Biometrika 31, 1940, 324-345), is twice
    /// the share less 1 where everybody compares everything.
    pub share: f64,
    /// Number of pairs of answers: two people, one scene, the same two filters.
    pub pairs: usize,
}

/// Compares the answers of all people about one shutter; none where no two people compared the same clips.
pub fn measure_agreement(sessions: &[&Session], shutter: usize) -> Option<PeopleAgreement> {
    let mut shares: HashMap<[usize; 3], Vec<f64>> = HashMap::new();
    for session in sessions {
        for (scene, own) in session.comparisons_by_scene(shutter) {
            // The smaller number comes first.
            let (clips, share) = match own.one < own.other {
                true => ([scene, own.one, own.other], own.share),
                false => ([scene, own.other, own.one], 1.0 - own.share),
            };
            shares.entry(clips).or_default().push(share);
        }
    }
    let (mut alike, mut pairs) = (0.0, 0);
    for shares in shares.values() {
        let count = |wanted: f64| shares.iter().filter(|share| **share == wanted).count();
        let counts = [0.0, 0.5, 1.0].map(count);
        let [second, neither, first] = counts;
        let two = |count: usize| count * count.saturating_sub(1) / 2;
        pairs += two(shares.len());
        alike += counts.map(two).iter().sum::<usize>() as f64;
        alike += 0.5 * (neither * (first + second)) as f64;
    }
    (pairs > 0).then(|| PeopleAgreement {
        share: alike / pairs as f64,
        pairs,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answers::Chosen;
    use crate::design::{Clip, ShownPair};
    use crate::question::Question;

    #[test]
    fn three_people_agree_as_kendall_counts() {
        let trial = |left, right| ShownPair {
            shutter: 0,
            scene: 0,
            left: Clip::Filter(left),
            right: Clip::Filter(right),
        };
        let session = |answers: Vec<(ShownPair, Chosen)>| Session {
            path: "a.json".into(),
            question: Question::Truth,
            seed: 0,
            answers,
        };
        // Two choose filter 0 whatever its side, one chooses filter 1: one of three pairs of people is alike.
        let mut people = [
            session(vec![(trial(0, 1), Chosen::Left)]),
            session(vec![(trial(1, 0), Chosen::Right)]),
            session(vec![(trial(0, 1), Chosen::Right)]),
        ];
        let all: Vec<&Session> = people.iter().collect();
        let found = measure_agreement(&all, 0).unwrap();
        assert_eq!((found.share, found.pairs), (1.0 / 3.0, 3));
        assert_eq!(measure_agreement(&all, 1), None);
        assert_eq!(measure_agreement(&all[..1], 0), None);
        people[2].answers[0].1 = Chosen::Neither;
        let all: Vec<&Session> = people.iter().collect();
        assert_eq!(measure_agreement(&all, 0).unwrap().share, 2.0 / 3.0);
    }
}
