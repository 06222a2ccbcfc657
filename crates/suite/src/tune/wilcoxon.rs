//! Wilcoxon's signed-rank test.

/// Probability that paired differences lean as far above 0 as these, or farther, if they were as likely below: exact, ranks
/// of equal sizes shared, zeros left out (Wilcoxon, "Individual Comparisons by Ranking Methods", 1945). 1 of no differences.
///
/// All 2^n signs are counted by their doubled rank sums, which shared ranks leave whole.
pub fn probability_not_above(differences: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = differences
        .iter()
        .copied()
        .filter(|it| *it != 0.0)
        .collect();
    sizes.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let mut doubled_ranks = Vec::new();
    for equal in sizes.chunk_by(|a, b| a.abs() == b.abs()) {
        let before = doubled_ranks.len();
        // Ranks before + 1 to before + n have the mean before + (n + 1) / 2.
        doubled_ranks.extend(equal.iter().map(|_| 2 * before + equal.len() + 1));
    }
    let above = sizes.iter().zip(&doubled_ranks);
    let observed: usize = above
        .filter(|(size, _)| **size > 0.0)
        .map(|(_, rank)| rank)
        .sum();
    let most: usize = doubled_ranks.iter().sum();
    let mut share = vec![0.0; most + 1];
    share[0] = 1.0;
    for rank in &doubled_ranks {
        for sum in (0..=most).rev() {
            let with = sum.checked_sub(*rank).map_or(0.0, |rest| share[rest]);
            share[sum] = 0.5 * (share[sum] + with);
        }
    }
    share[observed..].iter().sum()
}
