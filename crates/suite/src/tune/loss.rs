//! Loss of a candidate, which the search minimises.

use std::collections::BTreeMap;

use super::SceneScore;

/// What a candidate that does not run is told to have: as bad as an error e^3 = 20 times the start's.
pub const FAILED: f64 = 3.0;
/// Lateral bleed, in pixels, that is too little to be told from none.
pub const LEAST_BLEED: f64 = 0.01;
/// An error below this is as good as none: FLIP of half a step of 8 bits in one pixel of a thousand.
const LEAST_FLIP: f64 = 1e-6;
/// Weight of what a broken limit or bound is exceeded by, in parts of it: 10 % too much cost weighs as much as an error
/// 22 % larger.
const PENALTY: f64 = 2.0;

/// Log of a scene's error over that of the start: below 0 is better.
pub fn log_ratio(score: &SceneScore, start: &SceneScore) -> f64 {
    (score.flip.max(LEAST_FLIP) / start.flip.max(LEAST_FLIP)).ln()
}

/// Mean of [`log_ratio`] over the scenes that `scores` names. `None` of no scene.
pub fn mean_log_ratio(
    scores: &BTreeMap<String, SceneScore>,
    start: &BTreeMap<String, SceneScore>,
    counts: impl Fn(&str) -> bool,
) -> Option<f64> {
    let ratios: Vec<f64> = (scores.iter())
        .filter(|(scene, _)| counts(scene))
        .map(|(scene, score)| log_ratio(score, &start[scene]))
        .collect();
    (!ratios.is_empty()).then(|| ratios.iter().sum::<f64>() / ratios.len() as f64)
}

/// Returns the lateral bleed of the worst scene, in pixels.
pub fn worst_bleed(scores: &BTreeMap<String, SceneScore>) -> Option<f64> {
    let bleeds = scores.values().filter_map(|score| score.bleed);
    bleeds.max_by(f64::total_cmp)
}

/// A penalty for a value above its limit; none where there is no limit or no value.
pub fn penalty(value: Option<f64>, limit: Option<f64>) -> f64 {
    match (value, limit) {
        (Some(value), Some(limit)) if value > limit => {
            PENALTY * ((value - limit) / limit.max(SMALLEST_LIMIT)).min(1.0)
        }
        _ => 0.0,
    }
}

/// A penalty for broken bounds, from what they are exceeded by in parts of themselves.
pub fn bounds_penalty(excess: f64) -> f64 {
    PENALTY * excess.min(1.0)
}

/// A limit of zero, such as the bleed of a start that never bleeds, is exceeded by parts of this.
const SMALLEST_LIMIT: f64 = 0.05;
