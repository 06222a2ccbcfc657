//! Ranking of the filters of sequences, by means over the scenes.

use judge::{RANK_RULE, RANKED_BY, RankedSequence, rank_sequences};
use maud::{Markup, html};
use measure::{Run, SceneMean};
use metrics::SequenceMetric;

use crate::table::{Column, scroll_table};

/// Makes a table per shutter; nothing if the run has one scene, since that scene's table is ranked.
pub fn ranking_tables(run: &Run, scenes: usize) -> Markup {
    let groups = match scenes {
        ..=1 => Vec::new(),
        _ => rank_sequences(run),
    };
    let is_tied = groups
        .iter()
        .flatten()
        .any(|sequence| sequence.ranked.is_tied());
    html! {
        @if !groups.is_empty() {
            h2 { "Ranking" }
            p.note {
                "Means over " (scenes) " scenes, ranked by " (RANKED_BY.row().name) ": " (RANKED_BY.row().meaning) ". Grey: 95 % CI over the scenes."
                @if is_tied { " " (RANK_RULE) }
            }
            @for group in &groups {
                h3 { (group[0].ranked.alignment) " shutter" @if let Some(rate) = group[0].ranked.rate { ", " (rate.text()) } }
                (metric_table("Means over scenes", Some("worst scene"), &html! { @for sequence in group { (row(sequence, scenes)) } }))
            }
        }
    }
}

/// Writes a table of filters with a column for every score of sequences, and perhaps one more.
pub fn metric_table(label: &str, last: Option<&'static str>, rows: &Markup) -> Markup {
    let metrics = SequenceMetric::ALL.iter().map(|metric| metric.row().name);
    let columns = ["filter"].into_iter().chain(metrics).chain(last);
    let columns: Vec<Column> = columns.map(Column::Plain).collect();
    scroll_table(None, label, None, &columns, rows)
}

fn row(sequence: &RankedSequence, scenes: usize) -> Markup {
    let ranked = &sequence.ranked;
    let (scene, worst) = &ranked.worst;
    html! {
        tr {
            th scope="row" { (ranked.rank_text()) " " (ranked.shown_name()) }
            @for (metric, mean) in &sequence.means { td { (mean_text(*metric, mean.as_ref())) } }
            td {
                (scene) " " (RANKED_BY.shown_text(*worst))
                @if ranked.scenes < scenes { span.note { " (" (ranked.scenes) " of " (scenes) " scenes)" } }
            }
        }
    }
}

fn mean_text(metric: SequenceMetric, mean: Option<&SceneMean>) -> Markup {
    html! {
        @match mean {
            None => "n/a",
            Some(mean) => {
                (metric.shown_text(mean.mean))
                @if mean.scenes > 1 {
                    @let [low, high] = mean.interval.map(|end| metric.shown_text(end));
                    span.note { " " (low) " to " (high) }
                }
            }
        }
    }
}
