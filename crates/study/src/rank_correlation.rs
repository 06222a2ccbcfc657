//! Rank correlation of two lists of numbers.

use nalgebra::DVector;

/// Correlates the ranks of two lists of one length: 1 if both rank alike, -1 if one ranks in the opposite order (Spearman, "The proof
/// and measurement of association between two things", American Journal of Psychology 15, 1904, 72-101). Equal numbers share the mean
/// of their ranks. None if all numbers of a list are equal.
pub fn rank_correlation(one: &[f64], other: &[f64]) -> Option<f64> {
    let [one, other] = [one, other].map(centered_ranks);
    let scale = (one.norm_squared() * other.norm_squared()).sqrt();
    (scale > 0.0).then(|| one.dot(&other) / scale)
}

/// Ranks numbers from the least up; the mean rank is 0.
fn centered_ranks(values: &[f64]) -> DVector<f64> {
    let rank = |own: &f64| {
        let below = values.iter().filter(|value| *value < own).count();
        let above = values.iter().filter(|value| *value > own).count();
        (below as f64 - above as f64) / 2.0
    };
    DVector::from_iterator(values.len(), values.iter().map(rank))
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
    // Ranks 0.5, 0.5, 2, 3 and 0, 1, 2, 3: 4.5 over the root of 4.5 x 5.
    let tied = rank_correlation(&[1.0, 1.0, 2.0, 3.0], &rising).unwrap();
    assert!((tied - 0.9_f64.sqrt()).abs() < 1e-12, "{tied}");
}
