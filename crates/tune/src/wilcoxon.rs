//! Wilcoxon's signed-rank test.

/// Returns the one-sided p-value of paired differences: the probability that their rank sum above 0 is this large or larger if
/// each is as likely below 0. Exact; equal sizes share their ranks, and zeros are left out (Wilcoxon, "Individual Comparisons by
/// Ranking Methods", 1945). 1 for no differences.
///
/// Counts all 2^n signs by their doubled rank sums, which are whole numbers even for shared ranks.
pub fn signed_rank_p_value(differences: &[f64]) -> f64 {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_signed_rank_test_has_wilcoxons_probabilities() {
        // In Wilcoxon's table for n = 8, the smaller sum 5 is the last one below 5 % on one side, and 3 below 2.5 %. Of 2^8
        // arrangements, 5, 10 and 14 have a sum of at most 3, 5 and 6.
        let eight = |below: i32| {
            let signed = |rank: i32| f64::from(if rank == below { -rank } else { rank });
            (1..=8).map(signed).collect::<Vec<f64>>()
        };
        let rows: [(&[f64], f64); 8] = [
            (&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 1.0 / 64.0),
            (&[-1.0, -2.0, -3.0, -4.0, -5.0, -6.0], 1.0),
            // Equal sizes share their ranks, here 1.5 each: the sums 3, 1.5, 1.5 and 0 are equally likely.
            (&[1.0, 1.0], 0.25),
            (&[1.0, -1.0], 0.75),
            // Zeros do not count.
            (&[0.0, 1.0, 0.0, -1.0], 0.75),
            // The ranks are 2, 2, 2 and 4, and the sum is 6: 8 of 16 arrangements reach it. If the three had rank 1, 9 would.
            (&[1.0, 1.0, 1.0, -2.0], 0.5),
            (&[], 1.0),
            (&[0.0], 1.0),
        ];
        for (differences, probability) in rows {
            assert_eq!(
                signed_rank_p_value(differences),
                probability,
                "{differences:?}"
            );
        }
        for (below, count) in [(3, 5.0), (5, 10.0), (6, 14.0)] {
            assert_eq!(signed_rank_p_value(&eight(below)), count / 256.0);
        }
        // Darwin's heights of crossed less self-fertilised plants, in eighths of an inch: scipy.stats.wilcoxon gives W+ = 96
        // and, with alternative "greater", p = 0.0206.
        let plants = [49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48];
        let probability = signed_rank_p_value(&plants.map(f64::from));
        assert!((probability - 0.0206).abs() < 1e-4, "{probability}");
    }
}
