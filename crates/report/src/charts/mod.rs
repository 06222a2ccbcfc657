//! Charts as inline SVG.

pub mod plot;
pub mod strip;

/// Finds the smallest and the largest of some numbers; 0 and 1 without any.
pub fn ends(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let pairs = values.map(|value| (value, value));
    pairs
        .reduce(|(low, high), (value, _)| (low.min(value), high.max(value)))
        .unwrap_or((0.0, 1.0))
}

/// Returns whether no other point is as low in both coordinates and lower in one.
pub fn is_undominated(point: [f64; 2], all: &[[f64; 2]]) -> bool {
    let beats = |other: &[f64; 2]| other[0] <= point[0] && other[1] <= point[1] && *other != point;
    !all.iter().any(beats)
}
