//! Rank correlation of two lists of numbers.

/// Correlates the ranks of two lists: 1 if both rank alike, -1 if one ranks the other way round (Spearman, "The proof and measurement
/// of association between two things", American Journal of Psychology 15, 1904, 72-101). Equal numbers share the mean of their ranks.
/// None where all numbers of a list are equal.
///
/// # Panics
/// The lists differ in length.
pub fn rank_correlation(one: &[f64], other: &[f64]) -> Option<f64> {
    assert_eq!(one.len(), other.len(), "every thing has both numbers");
    let [one, other] = [one, other].map(ranks);
    let middle = (one.len() as f64 - 1.0) / 2.0;
    let product = |a: &[f64], b: &[f64]| -> f64 {
        a.iter()
            .zip(b)
            .map(|(a, b)| (a - middle) * (b - middle))
            .sum()
    };
    let scale = (product(&one, &one) * product(&other, &other)).sqrt();
    (scale > 0.0).then(|| product(&one, &other) / scale)
}

/// Ranks from 0 on.
fn ranks(values: &[f64]) -> Vec<f64> {
    let rank = |own: &f64| {
        let below = values.iter().filter(|value| *value < own).count();
        let equal = values.iter().filter(|value| *value == own).count();
        below as f64 + (equal as f64 - 1.0) / 2.0
    };
    values.iter().map(rank).collect()
}

#[test]
fn ranks_alone_count_and_ties_share_theirs() {
    let rising = [1.0, 2.0, 30.0, 31.0];
    assert_eq!(rank_correlation(&rising, &[0.1, 0.2, 0.3, 9.0]), Some(1.0));
    assert_eq!(rank_correlation(&rising, &[4.0, 3.0, 2.0, 1.0]), Some(-1.0));
    assert_eq!(rank_correlation(&rising, &[1.0; 4]), None);
    // 1 - 6 x 2 / (4 x 15), the formula for ranks without ties.
    let swapped = rank_correlation(&rising, &[2.0, 1.0, 3.0, 4.0]).unwrap();
    assert!((swapped - 0.8).abs() < 1e-12, "{swapped}");
    // Ranks 0.5, 0.5, 2, 3 beside 0, 1, 2, 3: 4.5 over the root of 4.5 x 5.
    let tied = rank_correlation(&[1.0, 1.0, 2.0, 3.0], &rising).unwrap();
    assert!((tied - 0.9_f64.sqrt()).abs() < 1e-12, "{tied}");
}
