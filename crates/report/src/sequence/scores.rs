//! Tables of scores over time.

use maud::{Markup, html};
use metrics::{Measured, SequenceMetric};
use suite::{Run, Sequence};

/// Makes a table per scene and shutter.
pub fn score_tables(run: &Run) -> Markup {
    let mut groups: Vec<[&str; 2]> = Vec::new();
    for own in &run.sequences {
        let group = [own.scene.as_str(), own.alignment.as_str()];
        if !groups.contains(&group) {
            groups.push(group);
        }
    }
    html! {
        @for [scene, alignment] in groups {
            h3 { (scene) ", " (alignment) " shutter" }
            div.scroll {
                table {
                    thead {
                        tr {
                            th { "filter" }
                            @for metric in SequenceMetric::ALL { th title=(metric.row().meaning) { (metric.row().name) } }
                        }
                    }
                    tbody {
                        @for (index, own) in run.sequences.iter().enumerate().filter(|(_, own)| {
                            own.scene == scene && own.alignment == alignment
                        }) {
                            (row(index, own))
                        }
                    }
                }
            }
        }
        dl.facts {
            @for metric in SequenceMetric::ALL {
                div { dt { (metric.row().name) } dd { (metric.row().meaning) } }
            }
        }
    }
}

fn row(index: usize, own: &Sequence) -> Markup {
    html! {
        tr {
            th {
                a href=(format!("#{index}")) {
                    @if own.is_reference { i { (own.filter) } } @else { (own.filter) }
                }
            }
            @for metric in SequenceMetric::ALL {
                td title=(score_title(own.scores.get(metric))) { (metric.text(own.scores.get(metric))) }
            }
        }
    }
}

fn score_title(score: &Measured) -> String {
    match score {
        Measured::Score(score) => format!("{:.3e}, noise floor {:.1e}", score.value, score.floor),
        Measured::NotApplicable { reason } => reason.clone(),
    }
}
