//! Wilcoxon's signed-rank test.

/// Returns the one-sided p-value of paired differences: the probability that their rank sum above 0
/// is this large or larger if each is as likely below 0. Exact; equal sizes share their ranks, and
/// zeros are left out (Wilcoxon, "Individual Comparisons by Ranking Methods", 1945). 1 for no
/// differences.
///
/// Counts all 2^n signs by their doubled rank sums, which are whole numbers even for shared ranks.
pub fn signed_rank_p_value(differences: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = differences
        .iter()
        .copied()
        .filter(|difference| *difference != 0.0)
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
