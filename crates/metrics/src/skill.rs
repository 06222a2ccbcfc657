//! Skill: the share of the way from no blur to the best that one frame can give.

use crate::picture::pooled::Pooled;
use crate::picture::scores::Found;
use crate::{Measured, SkillScores};

const NO_ENDS: &str =
    "no sharp picture of the shutter's middle was given: the ladder's rung of 1 sub-frame is one";

/// Errors over the moving region of the two pictures that skill is measured between.
#[derive(Clone, Copy, Debug)]
pub struct Ends {
    /// Errors of the sharp picture of the shutter's middle: skill 0.
    pub sharp: Pooled,
    /// Errors of the one-frame oracle: skill 1.
    pub best: Pooled,
}

/// Scores skill by each of its errors. `moving` is the picture that is scored; `ends` are missing if their pictures were not given.
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

/// Divides the error that the picture removes by the error that the one-frame oracle removes. The floor is the skill of a
/// picture without error: the highest that the truth's noise supports.
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
