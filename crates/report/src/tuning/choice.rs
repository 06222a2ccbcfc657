//! Choice of a tuning.

use std::collections::BTreeMap;

use maud::{Markup, html};

use crate::numbers::percent;
use suite::{Difference, PairedComparison, Preference, SceneScore, Tuning};

/// Least change of the error, in the log, that is worth another value: half of what the page's last digit shows.
const LEAST_CHANGE: f64 = 5e-4;

/// Compares the choice with the start on the scenes tuned on; none without scenes that both have.
fn compare_with_start(tuning: &Tuning) -> Option<Difference> {
    let chosen = &tuning.chosen.scenes;
    let pairs: BTreeMap<String, [SceneScore; 2]> = (tuning.start.scenes.iter())
        .filter_map(|(scene, start)| Some((scene.clone(), [*start, *chosen.get(scene)?])))
        .collect();
    (!pairs.is_empty()).then(|| PairedComparison::new(pairs).flip)
}

/// Tells whether the scenes tell the choice from the start: else it is not offered as one.
fn is_better(difference: &Difference) -> bool {
    difference.verdict == Preference::Second && difference.mean < -LEAST_CHANGE
}

/// Writes the outcome in a few sentences.
pub fn summary(tuning: &Tuning) -> Markup {
    let choice = &tuning.choice;
    let error = tuning
        .chosen
        .error
        .map_or_else(|| "n/a".to_owned(), percent);
    let difference = compare_with_start(tuning);
    html! {
        p.lead {
            @if choice.trial == 0 {
                "Keep the start: no trial beats it by more than the scenes can tell."
            } @else if let Some(own) = difference.as_ref().filter(|own| !is_better(own)) {
                "Keep the start: the scenes cannot tell trial " (choice.trial) " from it ("
                (percent(own.mean)) ", one-sided 95 % bounds " (percent(own.interval[0])) " and " (percent(own.interval[1])) ")."
            } @else {
                "Chosen: trial " (choice.trial) ", with an error " (error) " against the start's"
                @if let Some(cost) = tuning.chosen.cost { ", at " (format!("{cost:.2}")) " times its GPU time" }
                @if let Some(bleed) = tuning.chosen.bleed { ", lateral bleed on the worst scene " (format!("{bleed:.3}")) " px" }
                "."
            }
            @if let Some(opening) = tuning.held_out.last() {
                @let flip = &opening.paired.flip;
                " On " (flip.scenes) " held-out scenes: " (percent(flip.mean))
                ", one-sided 95 % bounds " (percent(flip.interval[0])) " and " (percent(flip.interval[1]))
                @match flip.verdict {
                    Preference::First => ": the start is better.",
                    Preference::Second => ": the choice is better.",
                    Preference::Undecided => ": too noisy to decide.",
                }
            }
        }
        p {
            "The error is the mean over scenes of log(FLIP / FLIP of the start), shown as a change in percent. The best is trial "
            (choice.best) "; of all within its standard error of " (format!("{:.3}", choice.standard_error))
            ", the one nearest to the start is chosen. " (tuning.dropped) " of " (tuning.trials)
            " trials were dropped after the first scenes, " (tuning.failed.len()) " did not run."
        }
    }
}

/// Lists start and choice, parameter by parameter.
pub fn values(tuning: &Tuning) -> Markup {
    let difference = compare_with_start(tuning);
    let is_offered = tuning.choice.trial == 0 || difference.is_none_or(|own| is_better(&own));
    let trial = match is_offered {
        true => "chosen".to_owned(),
        false => format!("trial {}", tuning.choice.trial),
    };
    html! {
        section {
            h2 { "Values" }
            div.scroll tabindex="0" role="region" aria-label="Values" {
                table.stacked {
                    caption { "Varied parameters" }
                    thead {
                        tr {
                            th scope="col" { "parameter" }
                            th scope="col" { "start" }
                            th scope="col" { (trial) }
                            th.text scope="col" { "tried" }
                        }
                    }
                    tbody {
                        @for (name, range) in &tuning.journal.vary {
                            @let (start, chosen) = (tuning.start.values.get(name), tuning.chosen.values.get(name));
                            tr {
                                th scope="row" { (name) }
                                td data-label="start" { @if let Some(value) = start { (value) } }
                                td data-label=(trial) { @if let Some(value) = chosen { @if start == chosen || !is_offered { (value) } @else { strong { (value) } } } }
                                td.text data-label="tried" { (range) }
                            }
                        }
                    }
                }
            }
            p.note {
                "In the folder, params.json holds the choice for " code { "evaluate --params" } ", preset.toml for a filter.toml."
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_that_the_scenes_cannot_tell_from_nothing_is_not_offered() {
        let difference = |mean, verdict| Difference {
            mean,
            interval: [mean - 0.01, mean + 0.01],
            scenes: 5,
            verdict,
        };
        assert!(is_better(&difference(-0.05, Preference::Second)));
        assert!(!is_better(&difference(-0.05, Preference::Undecided)));
        // `taps` 8 -> 11 for -0.0 %.
        assert!(!is_better(&difference(-0.0003, Preference::Second)));
    }
}
