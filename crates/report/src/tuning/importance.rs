//! Importance of parameters.

use maud::{Markup, html};

use crate::charts::strip::Strip;
use suite::{ParameterSensitivity, Sensitivity};

/// Lists the parameters, those that matter most first.
pub fn importance(found: &Sensitivity) -> Markup {
    let mut rows: Vec<(&String, &ParameterSensitivity)> = found.parameters.iter().collect();
    rows.sort_by(|(_, a), (_, b)| b.importance().total_cmp(&a.importance()));
    let most_effect = (rows.iter())
        .filter_map(|(_, own)| own.effects)
        .map(|own| own.mean_size + own.half_width(found.trajectories))
        .fold(0.0, f64::max);
    let effects = rows.iter().any(|(_, own)| own.effects.is_some());
    let indices = rows.iter().any(|(_, own)| own.indices.is_some());
    html! {
        section {
            h2 { "Which parameters can become constants" }
            p {
                "By " (found.candidates) " candidates all over the ranges, " (found.failed) " of which did not run. "
                @if effects {
                    "Effect (Morris): mean size of the change of the error, in the log, from one end of the range to the other. "
                }
                @if indices {
                    "First and total (Sobol): share of the error's variance that the parameter causes alone, and with all others. "
                }
                "Lines are 95 % CIs."
            }
            div.scroll tabindex="0" role="region" aria-label="Sensitivity" {
                table {
                    thead {
                        tr {
                            th scope="col" { "parameter" }
                            th.text scope="col" { "constant?" }
                            @if effects { th scope="col" { "effect" } th.chart scope="col" { "0 to " (format!("{most_effect:.2}")) } }
                            @if indices { th scope="col" { "first" } th scope="col" { "total" } th.chart scope="col" { "total, 0 to 1" } }
                        }
                    }
                    tbody {
                        @for (name, own) in rows {
                            tr {
                                th scope="row" { (name) }
                                td class=(if own.constant { "text better" } else { "text" }) { @if own.constant { "✓ yes" } @else { "no" } }
                                @if effects { (effect(own, found.trajectories, most_effect)) }
                                @if indices { (index(own)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn effect(own: &ParameterSensitivity, trajectories: usize, most: f64) -> Markup {
    let Some(effects) = own.effects else {
        return html! { td { "-" } td {} };
    };
    let width = effects.half_width(trajectories);
    let interval = [effects.mean_size - width, effects.mean_size + width];
    html! {
        td { (format!("{:.3}", effects.mean_size)) @if trajectories > 1 { span.note { (format!(" ± {width:.3}")) } } }
        td.chart { (bar(effects.mean_size, interval, most)) }
    }
}

fn index(own: &ParameterSensitivity) -> Markup {
    let Some(indices) = own.indices else {
        return html! { td { "-" } td { "-" } td {} };
    };
    let total = indices.total;
    html! {
        td { (format!("{:.3}", indices.first.value)) }
        td { (format!("{:.3}", total.value)) span.note { (format!(" {:.3} to {:.3}", total.low, total.high)) } }
        td.chart { (bar(total.value, [total.low, total.high], 1.0)) }
    }
}

fn bar(value: f64, interval: [f64; 2], most: f64) -> Markup {
    let strip = Strip {
        low: 0.0,
        high: most,
    };
    strip.draw(&html! { (strip.bar(0.0, value, "")) (strip.interval(interval)) })
}
