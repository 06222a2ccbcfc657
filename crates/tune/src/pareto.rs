//! Pareto front of trials.

/// Rounds bleed to a thousandth of a pixel, as in tables: less is no gain.
pub fn round_bleed(bleed: f64) -> f64 {
    (1000.0 * bleed).round() / 1000.0
}

/// Returns the indices of the rows that no other row beats: no other is as low in every column and
/// lower in one. Keeps the first of equal rows.
pub fn pareto_front(rows: &[Vec<f64>]) -> Vec<usize> {
    let beats = |a: &[f64], b: &[f64]| {
        let no_worse = a.iter().zip(b).all(|(a, b)| a <= b);
        no_worse && a != b
    };
    let is_unbeaten = |index: &usize| {
        let row = &rows[*index];
        let beaten = rows.iter().any(|other| beats(other, row));
        !beaten && !rows[..*index].contains(row)
    };
    (0..rows.len()).filter(is_unbeaten).collect()
}

#[test]
fn bleed_that_nobody_sees_wins_no_place_on_the_front() {
    let rows = |bleed: fn(f64) -> f64| {
        [
            [0.08, bleed(6.5e-5)],
            [0.63, bleed(0.0)],
            [0.0, bleed(0.009)],
        ]
        .map(|row| row.to_vec())
    };
    assert_eq!(pareto_front(&rows(|bleed| bleed)), [0, 1, 2]);
    assert_eq!(pareto_front(&rows(round_bleed)), [0, 2]);
}
