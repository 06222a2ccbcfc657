//! Ablation of a choice: parameters without effect return to the start.

use measure::Error;

use crate::evaluator::Evaluator;
use crate::next_trial::run_trial;
use crate::options::TuneOptions;
use crate::selection::{Choice, Loss, trial_settings};
use crate::trial::Trial;

/// Sets the changed parameters of a choice back to the start, one after the other in the order of
/// the axes, and measures the result. A parameter stays at the start if the loss to the best
/// remains acceptable. Returns the trial that is left, with the chosen one's number, and updates
/// `choice` (compare Fawcett and Hoos, "Analysing differences between algorithm configurations
/// through ablation", Journal of Heuristics 22, 2016).
///
/// A search moves a parameter without effect at random, and the trial nearest to the start still
/// has some such moves. The trials here depend on the choice alone and are not in the journal: a
/// search that goes on is not disturbed, and one that was interrupted repeats them.
pub fn ablate_choice(
    options: &TuneOptions,
    evaluator: &mut Evaluator,
    trials: &[Trial],
    choice: &mut Choice,
) -> Result<Trial, Error> {
    let space = &options.space;
    let limits = options.choice_limits(&trials[0]);
    let best = &trials[choice.best];
    let mut chosen = trials[choice.trial].clone();
    for axis in &space.axes {
        let start = &space.start.values[&axis.name];
        // A narrower range may leave out the start.
        if chosen.values[&axis.name] == *start || !axis.kind.allows(start) {
            continue;
        }
        let mut settings = trial_settings(space, &chosen);
        settings.values.insert(axis.name.clone(), start.clone());
        let trial = run_trial(options, evaluator, trials, &settings)?;
        if !limits.allow(&trial) {
            continue;
        }
        let loss = Loss::new(&trial, best, |_| true);
        if loss.is_acceptable() {
            choice.reset.push(axis.name.clone());
            choice.loss = loss;
            chosen = Trial {
                trial: choice.trial,
                ..trial
            };
        }
    }
    Ok(chosen)
}
