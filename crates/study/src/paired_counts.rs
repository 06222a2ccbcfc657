//! Counts of choices between two of several things.

/// Counts how often each of several things was chosen over each other one.
#[derive(Clone, Debug, PartialEq)]
pub struct PairedCounts {
    /// Number of things.
    pub items: usize,
    /// How often the thing of a row was chosen over that of a column, row by row. Halves are choices of neither.
    wins: Vec<f64>,
}

impl PairedCounts {
    /// Makes counts of no choice at all.
    pub fn new(items: usize) -> Self {
        Self {
            items,
            wins: vec![0.0; items * items],
        }
    }

    /// Adds one comparison: `share` is 1 if `one` was chosen, 0 if `other` was, and 1/2 if neither was.
    ///
    /// # Panics
    /// Both are the same thing.
    pub fn add(&mut self, one: usize, other: usize, share: f64) {
        assert_ne!(one, other, "a comparison is of two things");
        self.wins[one * self.items + other] += share;
        self.wins[other * self.items + one] += 1.0 - share;
    }

    /// Adds all comparisons of other counts of the same things.
    pub fn add_all(&mut self, others: &Self) {
        for (own, other) in self.wins.iter_mut().zip(&others.wins) {
            *own += other;
        }
    }

    /// Returns how often `one` was chosen over `other`.
    pub fn wins(&self, one: usize, other: usize) -> f64 {
        self.wins[one * self.items + other]
    }

    /// Returns how often both were compared.
    pub fn comparisons(&self, one: usize, other: usize) -> f64 {
        self.wins(one, other) + self.wins(other, one)
    }

    /// Returns how often a thing was chosen, and how often it was compared.
    pub fn totals(&self, one: usize) -> [f64; 2] {
        let others = || (0..self.items).filter(|other| *other != one);
        [
            others().map(|other| self.wins(one, other)).sum(),
            others().map(|other| self.comparisons(one, other)).sum(),
        ]
    }

    /// Groups things that comparisons connect, directly or through others; one group means that all can have one scale.
    pub fn connected(&self) -> Vec<Vec<usize>> {
        self.groups(|one, other| self.comparisons(one, other) > 0.0)
    }

    /// Groups things that beat one another, directly or through others. With more than one group the most likely scale is
    /// infinite: no thing of one of them was ever chosen over a thing of another (Ford 1957).
    pub fn tied(&self) -> Vec<Vec<usize>> {
        let reach: Vec<Vec<bool>> = (0..self.items)
            .map(|start| self.reach(start, |one, other| self.wins(one, other) > 0.0))
            .collect();
        self.groups(|one, other| reach[one][other] && reach[other][one])
    }

    /// Groups things by a relation and all that follows from it.
    fn groups(&self, are_related: impl Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for item in 0..self.items {
            if groups.iter().any(|group| group.contains(&item)) {
                continue;
            }
            let reached = self.reach(item, &are_related);
            groups.push((0..self.items).filter(|other| reached[*other]).collect());
        }
        groups
    }

    /// Marks all that a relation leads to.
    fn reach(&self, start: usize, leads: impl Fn(usize, usize) -> bool) -> Vec<bool> {
        let mut reached = vec![false; self.items];
        let mut open = vec![start];
        reached[start] = true;
        while let Some(item) = open.pop() {
            for (other, is_reached) in reached.iter_mut().enumerate() {
                if !*is_reached && leads(item, other) {
                    *is_reached = true;
                    open.push(other);
                }
            }
        }
        reached
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comparisons_connect_things_and_wins_both_ways_tie_them() {
        let mut counts = PairedCounts::new(4);
        counts.add(0, 1, 1.0);
        counts.add(2, 3, 0.5);
        assert_eq!(counts.connected(), [vec![0, 1], vec![2, 3]]);
        counts.add(1, 2, 1.0);
        assert_eq!(counts.connected(), [vec![0, 1, 2, 3]]);
        // Half a choice counts for both.
        assert_eq!(counts.tied(), [vec![0], vec![1], vec![2, 3]]);
        counts.add(3, 0, 1.0);
        assert_eq!(counts.tied(), [vec![0, 1, 2, 3]]);
        assert_eq!(counts.totals(3), [1.5, 2.0]);
    }
}
