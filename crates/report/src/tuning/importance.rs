//! Importance of parameters.

use maud::{Markup, html};
use tune::{ParameterSensitivity, Sensitivity};

use crate::charts::strip::Strip;

/// Lists the parameters, those that matter most first.
pub fn importance(found: &Sensitivity) -> Markup {
    let mut rows: Vec<(&String, &ParameterSensitivity)> = found.parameters.iter().collect();
    rows.sort_by(|(_, a), (_, b)| b.indices.total.value.total_cmp(&a.indices.total.value));
    html! {
        section {
            h2 { "Which parameters can become constants" }
            p {
                "By " (found.candidates) " candidates all over the ranges, " (found.failed) " of which did not run. "
                "First and total (Sobol): share of the error's variance that the parameter causes alone, and with all others. "
                "Lines are 95 % CIs."
            }
            div.scroll tabindex="0" role="region" aria-label="Sensitivity" {
                table {
                    caption.unseen { "Parameters by what they change" }
                    thead {
                        tr {
                            th scope="col" { "parameter" }
                            th.text scope="col" { "constant?" }
                            th scope="col" { "first" }
                            th scope="col" { "total" }
                            th.chart scope="col" { "total, 0 to 1" }
                        }
                    }
                    tbody { @for (name, own) in rows { (row(name, own)) } }
                }
            }
        }
    }
}

fn row(name: &str, own: &ParameterSensitivity) -> Markup {
    let (first, total) = (own.indices.first, own.indices.total);
    html! {
        tr {
            th scope="row" { (name) }
            td class=(if own.constant { "text better" } else { "text" }) { @if own.constant { "✓ yes" } @else { "no" } }
            td { (format!("{:.3}", first.value)) }
            td { (format!("{:.3}", total.value)) span.note { (format!(" {:.3} to {:.3}", total.low, total.high)) } }
            td.chart { (bar(total.value, [total.low, total.high])) }
        }
    }
}

/// Draws a share with its interval, from 0 to 1.
fn bar(value: f64, interval: [f64; 2]) -> Markup {
    let strip = Strip {
        low: 0.0,
        high: 1.0,
    };
    strip.draw(&html! { (strip.bar(0.0, value, "")) (strip.interval(interval)) })
}
