//! Pareto front of trials.

/// Returns the indices of the rows that no other row beats: no other is as low in every column and lower in one. Keeps the
/// first of equal rows.
pub fn pareto_front(rows: &[Vec<f64>]) -> Vec<usize> {
    let beats = |a: &[f64], b: &[f64]| {
        let no_worse = a.iter().zip(b).all(|(a, b)| a <= b);
        no_worse && a != b
    };
    let kept = |index: &usize| {
        let row = &rows[*index];
        let beaten = rows.iter().any(|other| beats(other, row));
        !beaten && !rows[..*index].contains(row)
    };
    (0..rows.len()).filter(kept).collect()
}
