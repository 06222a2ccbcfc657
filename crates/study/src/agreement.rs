//! Agreement between people.

use std::collections::HashMap;

use serde::Serialize;

use crate::paired_counts::Comparison;

/// How often two people chose alike.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PeopleAgreement {
    /// Share of the pairs of answers that agree; a choice of neither half agrees with any other. Random answers give 1/2. If everybody
    /// compares everything, the coefficient of agreement u (Kendall and Babington Smith, "On the method of paired comparisons",
    /// Biometrika 31, 1940, 324-345) is twice the share minus 1.
    pub share: f64,
    /// Number of pairs of answers: two people, one scene, the same two filters.
    pub pairs: usize,
}

/// Compares the choices of people; none if no two people compared the same clips.
pub fn measure_agreement(people: &[Vec<Comparison>]) -> Option<PeopleAgreement> {
    let mut shares: HashMap<[usize; 3], Vec<f64>> = HashMap::new();
    for own in people.iter().flatten() {
        let clips = [own.scene, own.one, own.other];
        shares.entry(clips).or_default().push(own.share);
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

#[test]
fn three_people_agree_as_kendall_counts() {
    let person = |share| {
        vec![Comparison {
            scene: 0,
            one: 0,
            other: 1,
            share,
        }]
    };
    let found = |shares: &[f64]| {
        let people: Vec<_> = shares.iter().copied().map(person).collect();
        measure_agreement(&people).map(|own| (own.share, own.pairs))
    };
    assert_eq!(found(&[1.0, 1.0, 0.0]), Some((1.0 / 3.0, 3)));
    assert_eq!(found(&[1.0, 1.0, 0.5]), Some((2.0 / 3.0, 3)));
    assert_eq!(found(&[1.0]), None);
}
