//! Importance of parameters.

use maud::{Markup, html};
use tune::{ParameterSensitivity, Sensitivity};

use crate::charts::strip::Strip;
use crate::table::Column::{Chart, Plain, Text};
use crate::table::scroll_table;

/// Lists the parameters, those that matter most first.
pub fn importance(found: &Sensitivity) -> Markup {
    let mut rows: Vec<(&String, &ParameterSensitivity)> = found.parameters.iter().collect();
    rows.sort_by(|(_, a), (_, b)| b.indices.total.value.total_cmp(&a.indices.total.value));
    let rows = html! { tbody { @for (name, own) in rows { (row(name, own)) } } };
    html! {
        section {
            h2 { "Which parameters can become constants" }
            p {
                "By " (found.candidates) " candidates all over the ranges, " (found.failed) " of which did not run. "
                "First and total (Sobol): share of the error's variance that the parameter causes alone, and with all others. "
                "Lines are 95 % CIs."
            }
            (scroll_table(None, "Sensitivity", None, &[
                Plain("parameter"), Text("constant?"), Plain("first"), Plain("total"),
                Chart("total, 0 to 1"),
            ], &rows))
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
    let strip = Strip::over([0.0, 1.0].into_iter());
    strip.draw(&html! { (strip.bar(0.0, value, "")) (strip.interval(interval)) })
}
