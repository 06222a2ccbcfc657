//! Skill: the share of the way from no blur to the best that one frame can give.

use serde::{Deserialize, Serialize};

use crate::picture::pooled::Pooled;
use crate::picture::scores::Found;
use crate::{Measured, SkillScores};

const NO_ENDS: &str =
    "no sharp picture of the shutter's middle was given: the ladder's rung of 1 sub-frame is one";

/// Errors over the moving region of the two pictures that skill is measured between.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ends {
    /// Errors of the sharp picture of the shutter's middle: skill 0.
    pub sharp: Pooled,
    /// Errors of the one-frame oracle: skill 1.
    pub best: Pooled,
}

/// Scores skill by each of its errors. `moving` is the picture that is scored; `ends` are missing
/// if their pictures were not given.
pub fn score_skill(moving: &Found, ends: Option<&Ends>) -> SkillScores {
    let score = |error: fn(&Pooled) -> f64| match (moving, ends) {
        (Ok((own, noise)), Some(ends)) => measure_skill(error, own, noise, ends),
        (Ok(_), None) => Measured::not_applicable(NO_ENDS),
        (Err(reason), _) => Measured::not_applicable(*reason),
    };
    SkillScores {
        mse: score(|pooled| pooled.mse),
        flip: score(|pooled| pooled.flip),
        label_total_variation: score(|pooled| pooled.label),
    }
}

/// Divides the error that the picture removes by the error that the one-frame oracle removes. The
/// floor is the skill of a picture without error: the highest that the truth's noise supports.
fn measure_skill(error: fn(&Pooled) -> f64, own: &Pooled, noise: &Pooled, ends: &Ends) -> Measured {
    let [sharp, best, own, noise] = [&ends.sharp, &ends.best, own, noise].map(error);
    let way = sharp - best;
    // The truth's noise alone could make a shorter way.
    if way <= noise {
        return Measured::not_applicable(format!(
            "the one-frame oracle takes {way:.1e} of the error of no blur away, which is no more than the truth's noise \
             makes, {noise:.1e}"
        ));
    }
    Measured::score((sharp - own) / way, (sharp - noise) / way)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Makes errors of the same size by each measure.
    fn pooled(error: f64) -> Pooled {
        Pooled {
            mse: error,
            relmse: 0.0,
            mae: 0.0,
            smape: 0.0,
            flip: error,
            flip_weighted_median: 0.0,
            flip_p95: 0.0,
            flip_p99: 0.0,
            flip_hdr: 0.0,
            ssim: None,
            label: error,
            label_p95: 0.0,
            grain: 0.0,
        }
    }

    fn skill(own: f64, noise: f64, [sharp, best]: [f64; 2]) -> [Measured; 3] {
        let [sharp, best] = [sharp, best].map(pooled);
        let ends = Ends { sharp, best };
        let scores = score_skill(&Ok((pooled(own), pooled(noise))), Some(&ends));
        [scores.mse, scores.flip, scores.label_total_variation]
    }

    #[test]
    fn skill_is_the_share_of_the_way_and_its_floor_ends_at_the_noise() {
        // The way from 0.5 to 0.25: half of it to 0.375, and 7 / 4 of it to the noise of 0.0625.
        for measured in skill(0.375, 0.0625, [0.5, 0.25]) {
            assert_eq!(measured, Measured::score(0.5, 1.75));
        }
        for (own, expected) in [(0.5, 0.0), (0.25, 1.0), (0.75, -1.0)] {
            for measured in skill(own, 0.0625, [0.5, 0.25]) {
                assert_eq!(measured.value(), Some(expected));
            }
        }
    }

    #[test]
    fn a_way_no_longer_than_the_noise_has_no_skill() {
        let applies = |noise| skill(0.375, noise, [0.5, 0.25]).map(|own| own.value().is_some());
        assert_eq!(applies(0.249), [true; 3]);
        assert_eq!(applies(0.25), [false; 3]);
        assert_eq!(applies(0.26), [false; 3]);
        let [measured, ..] = skill(0.375, 0.25, [0.5, 0.25]);
        let Measured::NotApplicable { reason } = measured else {
            panic!("{measured:?}");
        };
        assert!(reason.contains("2.5e-1 of the error"), "{reason}");
        let missing = score_skill(&Ok((pooled(0.3), pooled(0.1))), None);
        assert_eq!(missing.flip, Measured::not_applicable(NO_ENDS));
    }
}
