//! Skill: the share of the way from doing nothing to the best that one frame can give.

use crate::picture::pooled::Pooled;
use crate::picture::scores::Found;
use crate::{Measured, SkillScores};

/// Errors over the moving region of the two pictures that skill lies between.
#[derive(Clone, Copy, Debug)]
pub struct Ends {
    /// Errors of the instant, which is the picture of no blur: skill 0.
    pub nothing: Option<Pooled>,
    /// Errors of the one-frame oracle: skill 1; `None` if no such picture was given.
    pub best: Option<Pooled>,
}

/// Scores skill by each of its errors. `moving` is the picture that is scored.
pub fn score_skill(moving: &Found, ends: &Ends) -> SkillScores {
    let score = |error: fn(&Pooled) -> f64| match moving {
        Ok((own, noise)) => measure_skill(error, own, noise, ends),
        Err(reason) => Measured::not_applicable(*reason),
    };
    SkillScores {
        mse: score(|pooled| pooled.mse),
        flip: score(|pooled| pooled.flip),
        label_total_variation: score(|pooled| pooled.label),
    }
}

/// Divides the error that the picture takes away by what the one-frame oracle takes away. The floor is the skill of a picture
/// without error: the highest that the truth's noise can vouch for.
fn measure_skill(error: fn(&Pooled) -> f64, own: &Pooled, noise: &Pooled, ends: &Ends) -> Measured {
    let (Some(nothing), Some(best)) = (&ends.nothing, &ends.best) else {
        return Measured::not_applicable("no picture of the one-frame oracle was given");
    };
    let [nothing, best, own, noise] = [nothing, best, own, noise].map(error);
    let way = nothing - best;
    // A shorter way is one that the truth's noise could have made.
    if way <= noise {
        return Measured::not_applicable(format!(
            "the one-frame oracle takes {way:.1e} of the error of doing nothing away, which is no more than the truth's noise \
             makes, {noise:.1e}"
        ));
    }
    Measured::score((nothing - own) / way, (nothing - noise) / way)
}
