//! Trials of a tuning: those that no other beats, and the convergence of the search.

use maud::{Markup, html};
use report::charts::is_undominated;
use report::charts::plot::{Axis, Plot};
use report::numbers::percent;
use report::table::{Column, scroll_table};

use super::folder::TuneFolder;
use crate::advice::Advice;
use crate::pareto::round_bleed;
use crate::trial::{Trial, TrialOutcome};

/// Returns a measure of a trial; none if it was not measured.
type Measure = fn(&Trial) -> Option<f64>;

/// Measures that a chart shows against the error, with their titles.
const AGAINST: [(&str, Measure); 2] = [
    ("GPU time, start = 1", |trial| trial.cost),
    ("lateral bleed, worst scene, px", |trial| {
        trial.bleed.map(round_bleed)
    }),
];

/// Draws all trials, and lists those that no other beats.
pub fn front_section(folder: &TuneFolder) -> Markup {
    let done: Vec<&Trial> = (folder.trials.iter())
        .filter(|trial| trial.is_done())
        .collect();
    let tuning = folder.tuning.as_ref();
    // A choice that is not recommended is an ordinary trial.
    let taken = tuning.filter(|tuning| tuning.advice() == Advice::Take);
    let chosen = taken.map(|tuning| tuning.choice.trial);
    html! {
        section {
            h2 { "Trials that ran on every scene" }
            p.key {
                "Blue: no other trial is as good in both axes of the chart; grey: beaten; ring: the start"
                @if chosen.is_some() { "; the largest: the choice" }
                ". Down and left is good."
            }
            div.drawings {
                @for (title, measure) in AGAINST { (chart(&done, chosen, title, measure)) }
            }
            @if let Some(tuning) = tuning { (table(&tuning.front, &tuning.start, chosen)) }
        }
    }
}

fn chart(
    done: &[&Trial],
    chosen: Option<usize>,
    title: &str,
    measure: fn(&Trial) -> Option<f64>,
) -> Markup {
    // Trial, change of the error in percent, and the other measure.
    let points: Vec<(&Trial, [f64; 2])> = (done.iter())
        .filter_map(|trial| Some((*trial, [100.0 * trial.error?.exp_m1(), measure(trial)?])))
        .collect();
    if points.is_empty() {
        return html! {};
    }
    let places: Vec<[f64; 2]> = points.iter().map(|(_, place)| *place).collect();
    let along = |axis: usize| places.iter().map(move |place| place[axis]);
    let plot = Plot::small(
        Axis::linear("change of the error, %", along(0)),
        Axis::linear(title, along(1)),
    );
    let marks = html! {
        @for (trial, [error, other]) in &points {
            @let words = format!("trial {}: {error:+.1} %, {other:.3}", trial.trial);
            @let class = if is_undominated([*error, *other], &places) { "" } else { "faint" };
            @let radius = if Some(trial.trial) == chosen { 6.0 } else { 3.0 };
            (plot.mark((*error, *other), class, radius, &words))
            @if trial.trial == 0 { (plot.mark((*error, *other), "ring", 5.0, "the start")) }
        }
    };
    let label = format!("{} trials by change of the error and {title}", points.len());
    html! { figure { (plot.draw(&label, &marks)) } }
}

fn table(front: &[Trial], start: &Trial, chosen: Option<usize>) -> Markup {
    let number = |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{value:.3}"));
    // Unmeasured scores have no column.
    let [timed, bled] =
        AGAINST.map(|(_, measure)| front.iter().any(|trial| measure(trial).is_some()));
    let mut columns = vec![Column::Plain("trial"), Column::Plain("error")];
    columns.extend(bled.then_some(Column::Plain("lateral bleed, px")));
    columns.extend(timed.then_some(Column::Plain("GPU time")));
    columns.push(Column::Text("values that differ from the start"));
    let rows = html! {
        @for trial in front {
            tr {
                th scope="row" data-label="trial" { (trial.trial) @if Some(trial.trial) == chosen { " (chosen)" } @else if trial.trial == 0 { " (start)" } }
                td data-label="error" { (trial.error.map_or_else(|| "-".to_owned(), percent)) }
                @if bled { td data-label="lateral bleed, px" { (number(trial.bleed)) } }
                @if timed { td data-label="GPU time" { (number(trial.cost)) } }
                td.text data-label="values" { (differing(trial, start)) }
            }
        }
    };
    let caption = "Trials that no other one beats in every measure, lowest error first";
    scroll_table(
        Some("stacked"),
        "Unbeaten trials",
        Some(caption),
        &columns,
        &rows,
    )
}

/// Formats `samples 16, jitter start_offset`.
fn differing(trial: &Trial, start: &Trial) -> String {
    let differ =
        (trial.values.iter()).filter(|(name, value)| start.values.get(*name) != Some(value));
    let words: Vec<String> = differ
        .map(|(name, value)| format!("{name} {value}"))
        .collect();
    words.join(", ")
}

/// Largest loss in a chart: larger ones, and failed trials, are drawn here.
const MAX_LOSS: f64 = 1.0;

/// Draws the loss of every trial in order, and the smallest so far of trials that ran everywhere.
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
