//! Counts of choices between two of several things.

use nalgebra::DMatrix;

/// One comparison by one person.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Number of the scene that shows both things.
    pub scene: usize,
    /// Number of the first thing, the smaller one.
    pub one: usize,
    /// Number of the second thing.
    pub other: usize,
    /// 1 if the first was chosen, 0 if the second was, 1/2 if neither was.
    pub share: f64,
}

/// How often each of several things was chosen over each other one.
#[derive(Clone, Debug, PartialEq)]
pub struct PairedCounts {
    /// How often the row's thing was chosen over the column's. A choice of neither counts half for both.
    pub wins: DMatrix<f64>,
}

impl PairedCounts {
    /// Counts the comparisons of `items` things.
    pub fn new<'a>(items: usize, comparisons: impl IntoIterator<Item = &'a Comparison>) -> Self {
        let mut wins = DMatrix::zeros(items, items);
        for own in comparisons {
            wins[(own.one, own.other)] += own.share;
            wins[(own.other, own.one)] += 1.0 - own.share;
        }
        Self { wins }
    }

    /// Returns the number of things.
    pub fn items(&self) -> usize {
        self.wins.nrows()
    }

    /// Returns how often both were compared.
    pub fn comparisons(&self, one: usize, other: usize) -> f64 {
        self.wins[(one, other)] + self.wins[(other, one)]
    }

    /// Returns how often a thing was chosen, and how often it was compared.
    pub fn totals(&self, one: usize) -> [f64; 2] {
        let chosen = self.wins.row(one).sum();
        [chosen, chosen + self.wins.column(one).sum()]
    }

    /// Groups things that comparisons connect, directly or through others; one group means that all can have one scale.
    pub fn connected(&self) -> Vec<Vec<usize>> {
        self.groups(|one, other| self.comparisons(one, other) > 0.0)
    }

    /// Groups things that beat one another, directly or through others. With more than one group the most likely scale is
    /// infinite: no thing of one group ever beat one of another (Ford 1957).
    pub fn tied(&self) -> Vec<Vec<usize>> {
        self.groups(|one, other| self.wins[(one, other)] > 0.0)
    }

    /// Groups things that a relation connects in both directions, directly or through others.
    fn groups(&self, leads: impl Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
        let all = 0..self.items();
        let mut reaches = DMatrix::from_fn(all.len(), all.len(), leads);
        for by in all.clone() {
            for from in all.clone() {
                for to in all.clone() {
                    reaches[(from, to)] |= reaches[(from, by)] && reaches[(by, to)];
                }
            }
        }
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for item in all {
            let is_own =
                |group: &&mut Vec<usize>| reaches[(group[0], item)] && reaches[(item, group[0])];
            match groups.iter_mut().find(is_own) {
                Some(group) => group.push(item),
                None => groups.push(vec![item]),
            }
        }
        groups
    }
}

#[test]
fn comparisons_connect_things_and_wins_both_ways_tie_them() {
    let choices = [(0, 1, 1.0), (2, 3, 0.5), (1, 2, 1.0), (0, 3, 0.0)];
    let comparisons = choices.map(|(one, other, share)| Comparison {
        scene: 0,
        one,
        other,
        share,
    });
    let counts = |count| PairedCounts::new(4, &comparisons[..count]);
    assert_eq!(counts(2).connected(), [vec![0, 1], vec![2, 3]]);
    assert_eq!(counts(3).connected(), [vec![0, 1, 2, 3]]);
    // Half a choice counts for both.
    assert_eq!(counts(3).tied(), [vec![0], vec![1], vec![2, 3]]);
    assert_eq!(counts(4).tied(), [vec![0, 1, 2, 3]]);
    assert_eq!(counts(4).totals(3), [1.5, 2.0]);
}
