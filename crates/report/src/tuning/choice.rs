//! Choice of a tuning.

use maud::{Markup, html};

use super::percent;
use suite::{Preference, Tuning};

/// The outcome in a few sentences.
pub fn summary(tuning: &Tuning) -> Markup {
    let choice = &tuning.choice;
    let error = tuning
        .chosen
        .error
        .map_or_else(|| "n/a".to_owned(), percent);
    html! {
        p.lead {
            @if choice.trial == 0 {
                "No trial beats the start by more than the scenes can tell: the start stays."
            } @else {
                "Chosen: trial " (choice.trial) ", with an error " (error) " against the start's"
                @if let Some(cost) = tuning.chosen.cost { ", at " (format!("{cost:.2}")) " times its GPU time" }
                @if let Some(bleed) = tuning.chosen.bleed { ", lateral bleed on the worst scene " (format!("{bleed:.3}")) " px" }
                "."
            }
            @if let Some(result) = tuning.held_out.last() {
                @let flip = &result.paired.flip;
                " On " (flip.scenes) " held-out scenes: " (percent(flip.mean))
                ", with 95 % one-sided bounds " (percent(flip.interval[0])) " and " (percent(flip.interval[1]))
                @match flip.verdict {
                    Preference::First => ": the start is better.",
                    Preference::Second => ": the choice is better.",
                    Preference::Undecided => ": undecided.",
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

/// Start and choice, parameter by parameter.
pub fn values(tuning: &Tuning) -> Markup {
    html! {
        section {
            h2 { "Values" }
            div.scroll tabindex="0" role="region" aria-label="Values" {
                table {
                    thead {
                        tr {
                            th scope="col" { "parameter" }
                            th scope="col" { "start" }
                            th scope="col" { "chosen" }
                            th.text scope="col" { "tried" }
                        }
                    }
                    tbody {
                        @for (name, range) in &tuning.journal.vary {
                            @let (start, chosen) = (tuning.start.values.get(name), tuning.chosen.values.get(name));
                            tr {
                                th scope="row" { (name) }
                                td { @if let Some(value) = start { (value) } }
                                td { @if let Some(value) = chosen { @if start == chosen { (value) } @else { strong { (value) } } } }
                                td.text { (range) }
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
