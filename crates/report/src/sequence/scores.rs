//! Tables of scores over time.

use frame::Alignment;
use judge::{Finding, RankedSequence, rank_sequences_on};
use maud::{Markup, html};
use measure::{Run, Sequence};
use metrics::{Measured, Metric, SequenceMetric};
use scene::SceneId;

use super::ranking::metric_table;
use crate::finding_text::{Status, limit_text};

/// Makes a table per scene and shutter: references, then filters by their ranks, then those without
/// a rank.
pub fn score_tables(run: &Run, findings: &[Finding]) -> Markup {
    let mut groups: Vec<(&SceneId, Alignment)> = Vec::new();
    for sequence in &run.sequences {
        let group = (&sequence.scene, sequence.alignment);
        if !groups.contains(&group) {
            groups.push(group);
        }
    }
    html! {
        @for (scene, alignment) in groups {
            h3 { (scene) ", " (alignment) " shutter" }
            (metric_table("Scores over time", None, &html! {
                @for (index, rank, sequence) in order_rows(run, scene, alignment) { (row(index, &rank, sequence, findings)) }
            }))
        }
        dl.facts {
            @for metric in SequenceMetric::ALL {
                div { dt { (metric.row().name) } dd { (metric.row().meaning) } }
            }
        }
    }
}

/// Orders the sequences of one scene and shutter, each with its number in the run and its formatted
/// rank.
fn order_rows<'a>(
    run: &'a Run,
    scene: &SceneId,
    alignment: Alignment,
) -> Vec<(usize, String, &'a Sequence)> {
    let ranked: Vec<RankedSequence> = rank_sequences_on(run, scene).concat();
    let place = |sequence: &Sequence| {
        let mut ranked = ranked.iter().map(|entry| &entry.ranked);
        ranked.position(|filter| {
            filter.name == sequence.name && filter.alignment == sequence.alignment
        })
    };
    let all = run.sequences.iter().enumerate();
    let rows =
        all.filter(|(_, sequence)| sequence.scene == *scene && sequence.alignment == alignment);
    let mut rows: Vec<_> = rows
        .map(|(index, sequence)| (place(sequence), index, sequence))
        .collect();
    rows.sort_by_key(|(place, _, sequence)| (!sequence.is_reference, place.unwrap_or(usize::MAX)));
    let with_rank = rows.into_iter().map(|(place, index, sequence)| {
        let place = place.filter(|_| !sequence.is_reference);
        let rank = place.map(|at| ranked[at].ranked.rank_text() + " ");
        (index, rank.unwrap_or_default(), sequence)
    });
    with_rank.collect()
}

fn row(index: usize, rank: &str, sequence: &Sequence, findings: &[Finding]) -> Markup {
    html! {
        tr {
            th scope="row" {
                (rank)
                a href=(format!("#{index}")) {
                    @if sequence.is_reference { i { (sequence.name) } } @else { (sequence.name) }
                }
            }
            @for metric in SequenceMetric::ALL { (cell(sequence, metric, finding_about(sequence, metric, findings))) }
        }
    }
}

/// Shows a score, and the status of its bound if it has one.
fn cell(sequence: &Sequence, metric: SequenceMetric, finding: Option<&Finding>) -> Markup {
    let score = sequence.scores.get(metric);
    let status = finding.and_then(|finding| Status::of(finding.outcome));
    let mut title = score_title(score);
    title.extend(
        finding.map(|finding| format!(", limit {}: {}", limit_text(finding), finding.place)),
    );
    html! {
        td title=(title) class=[finding.and_then(Status::required_class)] {
            @if let Some(status) = status { (status) span.unseen { (status.word) " " } }
            (metric.text(score))
        }
    }
}

/// Finds the finding about a score of a filter's sequence.
fn finding_about<'a>(
    sequence: &Sequence,
    metric: SequenceMetric,
    findings: &'a [Finding],
) -> Option<&'a Finding> {
    findings.iter().find(|finding| {
        let key = (finding.metric, &finding.scene, &finding.filter);
        !sequence.is_reference && key == (Metric::Sequence(metric), &sequence.scene, &sequence.name)
    })
}

fn score_title(score: &Measured) -> String {
    match score {
        Measured::Score(score) => format!("{:.3e}, noise floor {:.1e}", score.value, score.floor),
        Measured::NotApplicable { reason } => reason.clone(),
    }
}
