//! A comparison as one page.

use maud::{Markup, html};

use super::chart::chart;
use super::pictures::Pictures;
use super::provenance::provenance;
use super::signed;
use crate::shell::shell;
use suite::Error;
use suite::number;
use suite::{Basis, Change, ChangeKind, rank_changes};
use suite::{Compared, Side};
use suite::{MeanChange, MeanKind};
use suite::{Pair, pairs, subject};

/// So many cases are shown in pictures, those that changed most.
const SHOWN: usize = 12;

/// Reads the pictures of what changed most and writes nothing; the same runs make the same bytes.
pub fn compare_page(compared: &Compared, first: &Side, second: &Side) -> Result<String, Error> {
    let rank_changes = rank_changes(&compared.changes);
    let pairs = pairs(&first.run, &second.run);
    let mut shown = Vec::new();
    for (scene, filter) in rank_changes.iter().take(SHOWN) {
        let pair = pairs
            .iter()
            .find(|pair| pair.first.scene == *scene && subject(pair.first) == *filter);
        let pair = pair.expect("a change is of a pair");
        shown.push(case(compared, pair, Pictures::read([first, second], pair)?));
    }
    let body = html! {
        p.lead { (summary(compared)) }
        p.key {
            span.better { "▼ better" } " " span.worse { "▲ worse" } " ≈ within noise or undecided, = the same. "
            "\"Worse by\" is how much farther from perfect the second run is; below 0 it is better."
        }
        (differences(compared))
        (means(&compared.means))
        @if !shown.is_empty() {
            section {
                h2 { "What changed most" }
                @for case in &shown { (case) }
            }
        }
        (all_changes(&compared.changes))
        (provenance(first, second))
    };
    let subtitle = compared.runs.join(" → ");
    let page = shell(
        "Shuttertruth: two runs",
        &subtitle,
        &body,
        &[include_str!("../assets/split.js")],
    );
    Ok(page.into_string())
}

fn summary(compared: &Compared) -> String {
    let count = |kind| {
        compared
            .changes
            .iter()
            .filter(|change| change.kind == kind)
            .count()
    };
    format!(
        "{} scores of cases that both runs have: {} better and {} worse, {} below the margins, {} within noise, {} the same.",
        compared.changes.len(),
        count(ChangeKind::Better),
        count(ChangeKind::Worse),
        count(ChangeKind::BelowMargin),
        count(ChangeKind::WithinNoise),
        count(ChangeKind::Same)
    )
}

/// Settings, and cases of one run alone.
fn differences(compared: &Compared) -> Markup {
    let sides = [
        (&compared.only_in_first, &compared.runs[0]),
        (&compared.only_in_second, &compared.runs[1]),
    ];
    html! {
        @if !compared.settings.is_empty() {
            section {
                h2 { "Settings that differ" }
                div.scroll tabindex="0" role="region" aria-label="Settings that differ" {
                    table {
                        thead { tr { th scope="col" { "setting" } th.text scope="col" { "first" } th.text scope="col" { "second" } } }
                        tbody {
                            @for own in &compared.settings {
                                tr { th scope="row" { (own.name) } td.text { (own.first) } td.text { (own.second) } }
                            }
                        }
                    }
                }
            }
        }
        @for (cases, run) in sides {
            @if !cases.is_empty() {
                details.failures {
                    summary { (cases.len()) " cases only in " (run) }
                    ul { @for case in cases { li { (case) } } }
                }
            }
        }
    }
}

/// One table per metric that anything changed of.
fn means(means: &[MeanChange]) -> Markup {
    let mut metrics: Vec<&str> = Vec::new();
    for mean in means.iter().filter(|mean| mean.kind != MeanKind::Same) {
        if !metrics.contains(&mean.metric.as_str()) {
            metrics.push(&mean.metric);
        }
    }
    html! {
        section {
            h2 { "Means over scenes" }
            @if metrics.is_empty() { p { "No filter changed." } }
            @for metric in metrics {
                (metric_means(metric, &means.iter().filter(|mean| mean.metric == metric).collect::<Vec<_>>()))
            }
        }
    }
}

fn metric_means(metric: &str, means: &[&MeanChange]) -> Markup {
    let ends = means
        .iter()
        .flat_map(|mean| mean.interval)
        .chain(means.iter().map(|mean| mean.worse));
    let most = ends.map(f64::abs).fold(0.0, f64::max);
    let same = means
        .iter()
        .filter(|mean| mean.kind == MeanKind::Same)
        .count();
    html! {
        h3 { (metric) }
        p.note { (metric.parse().map_or_else(|_| String::new(), metrics::Metric::meaning)) }
        div.scroll tabindex="0" role="region" aria-label=(format!("Means of {metric}")) {
            table {
                caption { "95 % CI: over scenes, by Student's t; " (same) " filters did not change" }
                thead {
                    tr {
                        th scope="col" { "filter" }
                        th.text scope="col" { "verdict" }
                        th scope="col" { "worse by" }
                        th scope="col" { "95 % CI" }
                        th scope="col" { "first" }
                        th scope="col" { "second" }
                        th scope="col" { "scenes" }
                        th.chart scope="col" { "← better, worse →" }
                    }
                }
                tbody {
                    @for mean in means.iter().filter(|mean| mean.kind != MeanKind::Same) {
                        tr {
                            th scope="row" { (mean.filter) }
                            (mean_verdict(mean.kind))
                            td { (signed(mean.worse)) }
                            td { (signed(mean.interval[0])) " to " (signed(mean.interval[1])) }
                            td { (number(mean.first)) }
                            td { (number(mean.second)) }
                            td { (mean.scenes) ": " (mean.better_worse[0]) " ▼ " (mean.better_worse[1]) " ▲" }
                            td.chart { (chart(mean.worse, mean.interval, most)) }
                        }
                    }
                }
            }
        }
    }
}

fn mean_verdict(kind: MeanKind) -> Markup {
    let (class, sign) = match kind {
        MeanKind::Better => ("text better", "▼ "),
        MeanKind::Worse => ("text worse", "▲ "),
        MeanKind::Same => ("text", "= "),
        MeanKind::BelowMargin | MeanKind::Undecided | MeanKind::TooFewScenes => ("text", "≈ "),
    };
    html! { td class=(class) { (sign) (kind.words()) } }
}

/// Both pictures under a divider, the truth, where it changed, and the scores.
fn case(compared: &Compared, pair: &Pair, pictures: Option<Pictures>) -> Markup {
    let filter = subject(pair.first);
    let changes = (compared.changes.iter())
        .filter(|change| change.scene == pair.first.scene && change.filter == filter);
    let title = format!("{} / {filter}", pair.first.scene);
    html! {
        h3 { (title) }
        @if let Some(pictures) = pictures {
            div.trio {
                figure {
                    div.pair {
                        img src=(pictures.second) alt=(format!("{title} in the second run"));
                        div.over { img src=(pictures.first) alt=(format!("{title} in the first run")); }
                    }
                    input type="range" min="0" max="100" value="50" aria-label="Divider: first run left, second right";
                    figcaption { "first run left of the divider, second right" }
                }
                @if let Some(truth) = pictures.truth {
                    figure { img src=(truth) alt="What the open shutter saw"; figcaption { "truth" } }
                }
                @if let Some(change) = pictures.change {
                    figure {
                        img src=(change) alt="Change of the visible difference from the truth";
                        figcaption { "change of FLIP: orange is worse, blue better, black none" }
                    }
                }
            }
        }
        div.scroll tabindex="0" role="region" aria-label=(format!("Scores of {title}")) {
            table { (change_heading(false)) tbody { @for change in changes { (change_row(change, false)) } } }
        }
    }
}

fn all_changes(changes: &[Change]) -> Markup {
    let rows: Vec<&Change> = changes
        .iter()
        .filter(|change| change.kind != ChangeKind::Same)
        .collect();
    html! {
        @if !rows.is_empty() {
            section {
                h2 { "Every score that is not the same" }
                details {
                    summary { (rows.len()) " scores" }
                    div.scroll tabindex="0" role="region" aria-label="Every score that is not the same" {
                        table { (change_heading(true)) tbody { @for change in rows { (change_row(change, true)) } } }
                    }
                }
            }
        }
    }
}

fn change_heading(named: bool) -> Markup {
    html! {
        thead {
            tr {
                @if named { th scope="col" { "scene / filter" } }
                th.text scope="col" { "metric" }
                th.text scope="col" { "verdict" }
                th scope="col" { "worse by" }
                th scope="col" { "95 % CI" }
                th scope="col" { "first" }
                th scope="col" { "second" }
            }
        }
    }
}

fn change_row(change: &Change, named: bool) -> Markup {
    let (class, sign) = match change.kind {
        ChangeKind::Better => ("text better", "▼ "),
        ChangeKind::Worse => ("text worse", "▲ "),
        ChangeKind::WithinNoise | ChangeKind::BelowMargin => ("text", "≈ "),
        ChangeKind::Same => ("text", "= "),
    };
    html! {
        tr {
            @if named { th scope="row" { (change.scene) " / " (change.filter) } }
            th.text scope="row" { (change.metric) }
            td class=(class) { (sign) (change.kind.words()) }
            td { (signed(change.worse)) }
            td {
                @match (change.interval, change.basis) {
                    (Some([low, high]), _) => { (signed(low)) " to " (signed(high)) }
                    (None, _) if change.kind == ChangeKind::Same => "",
                    (None, Basis::Floor | Basis::Replicates) => "by the floor",
                }
            }
            td { (number(change.first)) }
            td { (number(change.second)) }
        }
    }
}
