//! Importance of each parameter, and the error along its range.

use std::collections::BTreeSet;

use filters::Value;
use maud::{Markup, html};
use report::charts::ends;
use report::charts::plot::{Axis, Plot};
use report::charts::strip::Strip;
use report::table::Column::{Chart, Plain, Text};
use report::table::scroll_table;

use super::folder::TuneFolder;
use crate::sensitivity::{ParameterSensitivity, Sensitivity};

/// Ratio of a range's ends above which its axis is logarithmic.
const LOG_FROM: f64 = 30.0;
/// Largest error in a chart; larger ones are drawn here.
const MAX_ERROR: f64 = 1.0;

/// Draws one chart per parameter: every trial and, if it was studied, the line on which all other
/// parameters are at the start.
pub fn slices(folder: &TuneFolder) -> Markup {
    let trials = folder.trials.iter().filter(|trial| trial.error.is_some());
    let studied = folder
        .sensitivity
        .iter()
        .flat_map(|study| study.parameters.keys());
    let names: BTreeSet<&String> = trials
        .flat_map(|trial| trial.values.keys())
        .chain(studied)
        .collect();
    if names.is_empty() {
        return html! {};
    }
    html! {
        section {
            h2 { "Error along each parameter" }
            p.key {
                "Marks: trials, in which the other parameters vary as well; blue ran on every scene, grey only on the first ones. The \
                 line, where there is one: all others at the start, from a study of sensitivity. Errors are mean logs against the \
                 start; those above 1 are drawn at 1."
            }
            div.drawings {
                @for name in names { (slice(folder, name)) }
            }
        }
    }
}

fn slice(folder: &TuneFolder, name: &str) -> Markup {
    let trials = folder.trials.iter();
    let points: Vec<(&Value, f64, bool)> = trials
        .filter_map(|trial| {
            Some((
                trial.values.get(name)?,
                trial.error?.min(MAX_ERROR),
                trial.is_done(),
            ))
        })
        .collect();
    let studies = folder
        .sensitivity
        .iter()
        .filter_map(|study| study.parameters.get(name));
    let line: Vec<(&Value, f64)> = studies
        .flat_map(|parameter| &parameter.slice)
        .map(|(value, error)| (value, error.min(MAX_ERROR)))
        .collect();
    // A line has the order of the filter's own choices.
    let all = || {
        let points = points.iter().map(|(value, error, _)| (*value, *error));
        line.iter().copied().chain(points)
    };
    let values: Vec<&Value> = all().map(|(value, _)| value).collect();
    let words = distinct_words(&values);
    let plot = Plot::small(
        axis(name, &values, &words),
        Axis::linear("error", all().map(|(_, error)| error)),
    );
    let at = |value: &Value| place(value, &words);
    let places: Vec<(f64, f64)> = line
        .iter()
        .map(|(value, error)| (at(value), *error))
        .collect();
    let marks = html! {
        @for (value, error, done) in &points {
            @let class = if *done { "" } else { "faint" };
            (plot.mark((at(value), *error), class, 2.5, &format!("{value}: {error:.4}")))
        }
        @if places.len() > 1 { (plot.line("", &places)) }
    };
    html! { figure { (plot.draw(&format!("Error against {name}"), &marks)) } }
}

/// Lists the words of a choice, each once, in order of appearance; none for numbers.
fn distinct_words(values: &[&Value]) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for value in values {
        if let Value::Choice(word) = value
            && !words.contains(word)
        {
            words.push(word.clone());
        }
    }
    words
}

fn place(value: &Value, words: &[String]) -> f64 {
    match value {
        Value::Integer(whole) => f64::from(*whole),
        Value::Real(real) => *real,
        Value::Choice(word) => words.iter().position(|choice| choice == word).unwrap_or(0) as f64,
    }
}

fn axis(name: &str, values: &[&Value], words: &[String]) -> Axis {
    if !words.is_empty() {
        return Axis::words(name, words);
    }
    let numbers = || values.iter().map(|value| place(value, words));
    let (low, high) = ends(numbers());
    if low > 0.0 && high / low > LOG_FROM {
        Axis::log(name, numbers())
    } else {
        Axis::linear(name, numbers())
    }
}

/// Lists the parameters, most important first.
pub fn importance(sensitivity: &Sensitivity) -> Markup {
    let mut rows: Vec<(&String, &ParameterSensitivity)> = sensitivity.parameters.iter().collect();
    rows.sort_by(|(_, a), (_, b)| b.indices.total.value.total_cmp(&a.indices.total.value));
    let rows = html! { tbody { @for (name, parameter) in rows { (row(name, parameter)) } } };
    html! {
        section {
            h2 { "Which parameters can become constants" }
            p {
                "From " (sensitivity.candidates) " candidates all over the ranges; " (sensitivity.failed) " of them did not run. "
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

fn row(name: &str, parameter: &ParameterSensitivity) -> Markup {
    let (first, total) = (parameter.indices.first, parameter.indices.total);
    html! {
        tr {
            th scope="row" { (name) }
            td class=(if parameter.constant { "text better" } else { "text" }) { @if parameter.constant { "✓ yes" } @else { "no" } }
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
