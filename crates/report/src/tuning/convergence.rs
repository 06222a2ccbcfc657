//! Convergence of the search.

use maud::{Markup, html};
use tune::{Trial, TrialOutcome};

use crate::charts::plot::{Axis, Plot};

/// Largest loss that is drawn: failed trials, and those far off, are drawn here.
const MAX_LOSS: f64 = 1.0;

/// Loss of every trial in its order, and the least so far of those that ran everywhere.
pub fn convergence(trials: &[Trial]) -> Markup {
    let loss = |trial: &Trial| trial.loss.min(MAX_LOSS);
    let mut best: Vec<(f64, f64)> = Vec::new();
    for trial in trials.iter().filter(|trial| trial.is_done()) {
        let least = best.last().map_or(f64::INFINITY, |(_, least)| *least);
        let at = trial.trial as f64;
        if let Some((_, last)) = best.last().copied() {
            best.push((at, last));
        }
        best.push((at, least.min(loss(trial))));
    }
    if let (Some((_, last)), Some(end)) = (best.last().copied(), trials.last()) {
        best.push((end.trial as f64, last));
    }
    let plot = Plot::small(
        Axis::linear("trial", trials.iter().map(|trial| trial.trial as f64)),
        Axis::linear("loss", trials.iter().map(loss)),
    );
    let marks = html! {
        @for trial in trials {
            @let class = if trial.is_done() { "" } else { "faint" };
            (plot.mark((trial.trial as f64, loss(trial)), class, 2.5, &words(trial)))
        }
        (plot.line("", &best))
    };
    let label = format!("Loss of {} trials in their order", trials.len());
    html! {
        section {
            h2 { "Convergence" }
            p.key {
                "Blue: ran on every scene; grey: dropped after some scenes, or did not run; the line: the least loss so far. The loss \
                 is the error, with penalties where limits or bounds are broken; losses above 1 are drawn at 1."
            }
            figure.large { (plot.draw(&label, &marks)) }
        }
    }
}

fn words(trial: &Trial) -> String {
    let outcome = match &trial.outcome {
        TrialOutcome::Done => "ran on every scene",
        TrialOutcome::Dropped => "dropped",
        TrialOutcome::Failed { .. } => "did not run",
    };
    format!("trial {}: loss {:.4}, {outcome}", trial.trial, trial.loss)
}
