//! Loss of a candidate, which the search minimises.

use crate::target::{SceneScore, SceneScores};

/// Loss of a candidate that does not run: as bad as an error e^3 = 20 times the start's.
pub const FAILED: f64 = 3.0;
/// Lateral bleed, in pixels, below which a difference counts as none.
pub const LEAST_BLEED: f64 = 0.01;
/// FLIP that counts as none: half a step of 8 bits in one pixel of a thousand.
const LEAST_FLIP: f64 = 1e-6;
/// Weight of an exceeded limit or bound, per fraction of the limit: 10 % too much cost weighs as
/// much as an error 22 % larger.
const PENALTY: f64 = 2.0;
/// Divisor for smaller limits, such as the bleed of a start that never bleeds.
const SMALLEST_LIMIT: f64 = 0.05;

/// Returns the log of a scene's error relative to the start's: below 0 is better.
pub fn log_ratio(score: &SceneScore, start: &SceneScore) -> f64 {
    (score.flip.max(LEAST_FLIP) / start.flip.max(LEAST_FLIP)).ln()
}

/// Lists [`log_ratio`] of the scenes of `scores` that `counts` selects.
pub fn log_ratios(
    scores: &SceneScores,
    start: &SceneScores,
    counts: impl Fn(&str) -> bool,
) -> Vec<f64> {
    (scores.iter())
        .filter(|(scene, _)| counts(scene))
        .map(|(scene, score)| log_ratio(score, &start[scene]))
        .collect()
}

/// Averages [`log_ratios`]; none if `counts` selects no scene.
pub fn mean_log_ratio(
    scores: &SceneScores,
    start: &SceneScores,
    counts: impl Fn(&str) -> bool,
) -> Option<f64> {
    let ratios = log_ratios(scores, start, counts);
    (!ratios.is_empty()).then(|| ratios.iter().sum::<f64>() / ratios.len() as f64)
}

/// Returns the lateral bleed of the worst scene, in pixels.
pub fn worst_bleed(scores: &SceneScores) -> Option<f64> {
    let bleeds = scores.values().filter_map(|score| score.bleed);
    bleeds.max_by(f64::total_cmp)
}

/// Returns the penalty for a value above its limit; 0 if there is no limit or no value.
pub fn penalty(value: Option<f64>, limit: Option<f64>) -> f64 {
    match (value, limit) {
        (Some(value), Some(limit)) if value > limit => {
            PENALTY * ((value - limit) / limit.max(SMALLEST_LIMIT)).min(1.0)
        }
        _ => 0.0,
    }
}

/// Returns the penalty for broken bounds, from the fraction by which they are exceeded.
pub fn bounds_penalty(excess: f64) -> f64 {
    PENALTY * excess.min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_too_much_costs_a_quarter_of_the_weight() {
        assert_eq!(penalty(Some(5.0), Some(4.0)), 0.25 * PENALTY);
        assert_eq!(bounds_penalty(0.25), 0.25 * PENALTY);
        // Never more than the whole weight; nothing at the limit.
        assert_eq!(penalty(Some(9.0), Some(4.0)), PENALTY);
        assert_eq!(penalty(Some(4.0), Some(4.0)), 0.0);
        // A limit of 0 counts as 0.05.
        assert_eq!(penalty(Some(0.025), Some(0.0)), 0.5 * PENALTY);
    }
}
