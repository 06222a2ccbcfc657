//! Ranking of the filters of sequences, by means over the scenes.

use judge::{RANK_RULE, RANKED_BY, RankedSequence, rank_sequences};
use maud::{Markup, html};
use metrics::SequenceMetric;
use suite::{Run, SceneMean};

/// Makes a table per shutter; nothing where the run has one scene, whose own table is ranked.
pub fn ranking_tables(run: &Run, scenes: usize) -> Markup {
    let groups = match scenes {
        ..=1 => Vec::new(),
        _ => rank_sequences(run),
    };
    let is_tied = groups.iter().flatten().any(|own| own.ranked.is_tied());
    html! {
        @if !groups.is_empty() {
            h2 { "Ranking" }
            p.note {
                "Means over " (scenes) " scenes, ranked by " (RANKED_BY.row().name) ": " (RANKED_BY.row().meaning) ". Grey: 95 % CI over the scenes."
                @if is_tied { " " (RANK_RULE) }
            }
            @for group in &groups {
                h3 { (group[0].ranked.alignment) " shutter" @if let Some(rate) = group[0].ranked.rate { ", " (rate.text()) } }
                (metric_table(Some("worst scene"), &html! { @for own in group { (row(own, scenes)) } }))
            }
        }
    }
}

/// Writes a table of filters with a column for every score of sequences, and perhaps one more.
pub fn metric_table(last: Option<&str>, rows: &Markup) -> Markup {
    html! {
        div.scroll {
            table {
                thead {
                    tr {
                        th { "filter" }
                        @for metric in SequenceMetric::ALL { th title=(metric.row().meaning) { (metric.row().name) } }
                        @if let Some(title) = last { th { (title) } }
                    }
                }
                tbody { (rows) }
            }
        }
    }
}

fn row(own: &RankedSequence, scenes: usize) -> Markup {
    let ranked = &own.ranked;
    let (scene, worst) = &ranked.worst;
    html! {
        tr {
            th { (ranked.rank_text()) " " (ranked.name) }
            @for (metric, mean) in &own.means { td { (mean_text(*metric, mean.as_ref())) } }
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
