//! Choice of a tuning.

use maud::{Markup, html};
use report::numbers::percent;
use report::table::Column::{Plain, Text};
use report::table::scroll_table;

use crate::advice::Advice;
use crate::comparison::Preference;
use crate::tuning::Tuning;

/// Writes the outcome in a few sentences.
pub fn summary(tuning: &Tuning) -> Markup {
    let choice = &tuning.choice;
    let error = tuning
        .chosen
        .error
        .map_or_else(|| "n/a".to_owned(), percent);
    html! {
        p.lead {
            @match tuning.advice() {
                Advice::NoneIsBetter => "Keep the start: no trial beats it by more than the scenes can show.",
                Advice::CannotTell(difference) => {
                    "Keep the start: the scenes cannot separate trial " (choice.trial) " from it ("
                    (difference.text(percent)) ")."
                }
                Advice::StartIsBetter(_) => {
                    "Keep the start: it is better than trial " (choice.trial) " on the held-out scenes."
                }
                Advice::Take => {
                    "Chosen: trial " (choice.trial) ", with an error " (error) " against the start's"
                    @if let Some(cost) = tuning.chosen.cost { ", at " (format!("{cost:.2}")) " times its GPU time" }
                    @if let Some(bleed) = tuning.chosen.bleed { ", lateral bleed on the worst scene " (format!("{bleed:.3}")) " px" }
                    "."
                }
            }
            @if let Some(result) = tuning.held_out.last() {
                @let flip = &result.paired.flip;
                " Held out: " (flip.text(percent))
                @match flip.verdict {
                    Preference::First => ": the start is better.",
                    Preference::Second => ": the choice is better.",
                    Preference::Undecided => ": too noisy to decide.",
                }
            }
        }
        p {
            "The error is the mean over scenes of log(FLIP / FLIP of the start), shown as a change in percent. The best is trial "
            (choice.best) ". Trial " (choice.trial) " is the nearest to the start that the scenes do not tell from it (difference "
            (percent(choice.loss.mean)) ", standard error " (format!("{:.1} %", 100.0 * choice.loss.standard_error)) "). "
            @if !choice.reset.is_empty() {
                "Set back to the start, without an effect that the scenes show: " (choice.reset.join(", ")) ". "
            }
            (tuning.dropped) " of " (tuning.trials)
            " trials were dropped after the first scenes, " (tuning.failed.len()) " did not run."
        }
    }
}

/// Lists start and choice, parameter by parameter.
pub fn values(tuning: &Tuning) -> Markup {
    let advice = tuning.advice();
    let is_offered = advice == Advice::Take;
    let trial = if is_offered || advice == Advice::NoneIsBetter {
        "chosen".to_owned()
    } else {
        format!("trial {}", tuning.choice.trial)
    };
    let rows = html! {
        @for (name, range) in &tuning.journal.vary {
            @let (start, chosen) = (tuning.start.values.get(name), tuning.chosen.values.get(name));
            tr {
                th scope="row" { (name) }
                td data-label="start" { @if let Some(value) = start { (value) } }
                td data-label=(trial) { @if let Some(value) = chosen { @if start == chosen || !is_offered { (value) } @else { strong { (value) } } } }
                td.text data-label="tried" { (range) }
            }
        }
    };
    html! {
        section {
            h2 { "Values" }
            (scroll_table(Some("stacked"), "Values", Some("Varied parameters"), &[
                Plain("parameter"), Plain("start"), Plain(&trial), Text("tried"),
            ], &rows))
            p.note {
                "In the folder, params.json holds these values for " code { "shuttertruth tune evaluate" }
                @if is_offered { ", and preset.toml holds them for a filter.toml" }
                "."
            }
        }
    }
}
