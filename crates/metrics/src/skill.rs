//! Skill: the share of the way from doing nothing to the best that one frame can give.

use crate::color::pooled::Pooled;
use crate::color::pooled_scores::Found;
use crate::{Measured, SkillScores};

/// Errors over the moving region of the two pictures that skill lies between.
#[derive(Clone, Copy, Debug)]
pub struct Ends {
    /// Errors of the instant, which is the picture of no blur: skill 0.
    pub nothing: Option<Pooled>,
    /// Errors of the one-frame oracle: skill 1; none where no such picture was given.
    pub best: Option<Pooled>,
}

/// Skill by each of its errors. `moving` is the picture that is scored.
pub fn skill_scores(moving: &Found, ends: &Ends) -> SkillScores {
    let skill = |error: fn(&Pooled) -> f64| match moving {
        Ok((own, noise)) => skill(error, own, noise, ends),
        Err(reason) => Measured::not_applicable(*reason),
    };
    SkillScores {
        mse: skill(|pooled| pooled.mse),
        flip: skill(|pooled| pooled.flip),
        label_total_variation: skill(|pooled| pooled.label),
    }
}

/// Divides the error that the picture takes away by what the one-frame oracle takes away. The floor is the skill of a picture
/// without error: the highest that the truth's noise can vouch for.
fn skill(error: fn(&Pooled) -> f64, own: &Pooled, noise: &Pooled, ends: &Ends) -> Measured {
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
