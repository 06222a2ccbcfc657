//! Page of a comparison.

use judge::{Change, ChangeKind, MeanChange, Pair, RunComparison, pair_cases, rank_changes};
use maud::{Markup, html};
use measure::{Error, StoredRun};
use metrics::Metric;

use super::cells::ChangeCells;
use super::pictures::Pictures;
use super::runs::both_runs;
use crate::charts::strip::Strip;
use crate::document::{Document, Siblings};
use crate::table::Column::{Chart, Plain, Text};
use crate::table::{grouped_table, scroll_table};

/// Number of cases with pictures, the largest changes.
const SHOWN: usize = 12;

/// Makes the page of a comparison. Reads the pictures of the largest changes and writes no file;
/// the same runs make the same bytes.
pub fn compare_page(
    compared: &RunComparison,
    first: &StoredRun,
    second: &StoredRun,
) -> Result<String, Error> {
    let ranked = rank_changes(&compared.changes);
    let both = pair_cases(&first.run, &second.run);
    let mut shown = Vec::new();
    for (scene, filter) in ranked.iter().take(SHOWN) {
        let is_of =
            |pair: &&Pair| pair.first.scene == **scene && pair.first.filter_id() == **filter;
        let pair = both.iter().find(is_of);
        let pair = pair.expect("a change is of a pair");
        shown.push(case(compared, pair, Pictures::read([first, second], pair)?));
    }
    let body = html! {
        p.lead { (summary(compared)) }
        p.key {
            "Change: the second run less the first. All scores are estimates without the truth's noise. "
            span.better { "better" } " and " span.worse { "worse" } ": beyond noise, and beyond the margin. "
            "A score with an ideal value, such as extent, changes by its distance from that value."
        }
        @if !shown.is_empty() {
            section {
                h2 { "What changed most" }
                @for case in &shown { (case) }
            }
        }
        (means(&compared.means))
        (differences(compared))
        (all_changes(&compared.changes))
        (both_runs(first, second))
    };
    let subtitle = compared.runs.join(" → ");
    let document = Document {
        title: "Shuttertruth: two runs",
        heading: html! { "Shuttertruth: two runs" },
        subtitle: &subtitle,
        body: html! { main { (body) } },
        scripts: &[include_str!("../assets/split.js")],
        siblings: Siblings::None,
    };
    Ok(document.render())
}

fn summary(compared: &RunComparison) -> String {
    let changes = || compared.changes.iter();
    let count = |kind| changes().filter(|change| change.kind == kind).count();
    format!(
        "{} scores are in both runs: {} better and {} worse, {} within margin, {} within noise, {} the same.",
        compared.changes.len(),
        count(ChangeKind::Better),
        count(ChangeKind::Worse),
        count(ChangeKind::BelowMargin),
        count(ChangeKind::WithinNoise),
        count(ChangeKind::Same)
    )
}

/// Lists settings that differ, and cases of only one run.
fn differences(compared: &RunComparison) -> Markup {
    let sides = [
        (&compared.only_in_first, &compared.runs[0]),
        (&compared.only_in_second, &compared.runs[1]),
    ];
    let rows = html! {
        @for setting in &compared.settings {
            tr { th scope="row" { (setting.name) } td.text { (setting.first) } td.text { (setting.second) } }
        }
    };
    html! {
        @if !compared.settings.is_empty() {
            section {
                h2 { "Settings that differ" }
                (scroll_table(None, "Settings that differ", None, &[
                    Plain("setting"), Text("first"), Text("second"),
                ], &rows))
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

/// Lists the mean changes of every metric with a change.
fn means(means: &[MeanChange]) -> Markup {
    let mut changed: Vec<&MeanChange> = means
        .iter()
        .filter(|mean| mean.kind != ChangeKind::Same)
        .collect();
    // The filters of one metric follow each other.
    let place = |metric: Metric| means.iter().position(|mean| mean.metric == metric);
    changed.sort_by_key(|mean| place(mean.metric));
    let caption = "Filters that changed. 95 % CI: over scenes, by Student's t";
    let bodies = html! {
        @for changes in changed.chunk_by(|a, b| a.metric == b.metric) {
            (metric_means(changes, largest_of_kind(&changed, changes[0].metric)))
        }
    };
    html! {
        section {
            h2 { "Means over scenes" }
            @if changed.is_empty() { p { "No filter changed." } }
            @else { (grouped_table(None, "Means over scenes", Some(caption), &[
                Plain("filter"), Plain("first"), Plain("second"), Text("change"), Plain("95 % CI"),
                Plain("scenes"), Chart("← better, worse →"),
            ], &bodies)) }
        }
    }
}

/// Returns the largest change of all scores of a metric's kind, which share a scale: those of its
/// unit, or of a metric without a unit its own.
fn largest_of_kind(means: &[&MeanChange], metric: Metric) -> f64 {
    let is_of_kind = |other: Metric| {
        other == metric || !metric.unit().is_empty() && other.unit() == metric.unit()
    };
    let means = means.iter().filter(|mean| is_of_kind(mean.metric));
    let ends = means.flat_map(|mean| mean.interval.into_iter().chain([mean.worse]));
    ends.map(f64::abs).fold(0.0, f64::max)
}

/// Writes the rows of one metric, on a scale up to `most`.
fn metric_means(means: &[&MeanChange], most: f64) -> Markup {
    let metric = means[0].metric;
    html! {
        tbody.group {
            tr {
                th scope="rowgroup" colspan="7" {
                    (metric) " " span.note { (metric.meaning()) }
                }
            }
        }
        tbody {
            @for mean in means {
                @let cells = ChangeCells::from(*mean);
                tr {
                    th scope="row" { (mean.filter) }
                    td { (cells.first) }
                    td { (cells.second) }
                    td class=(change_class(mean.kind)) { (cells.change) }
                    td { (cells.interval) }
                    td { (mean.better_worse[0]) " better, " (mean.better_worse[1]) " worse of " (mean.scenes) }
                    td.chart { (change_strip(mean, most)) }
                }
            }
        }
    }
}

/// Shows both pictures under a divider, the truth, the change of the error, and the scores.
fn case(compared: &RunComparison, pair: &Pair, pictures: Option<Pictures>) -> Markup {
    let filter = pair.first.filter_id();
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
        (change_table(&format!("Scores of {title}"), false, changes))
    }
}

fn all_changes(changes: &[Change]) -> Markup {
    const TITLE: &str = "Every score that is not the same";
    let rows: Vec<&Change> = changes
        .iter()
        .filter(|change| change.kind != ChangeKind::Same)
        .collect();
    html! {
        @if !rows.is_empty() {
            section {
                h2 { (TITLE) }
                details {
                    summary { (rows.len()) " scores" }
                    (change_table(TITLE, true, rows.into_iter()))
                }
            }
        }
    }
}

/// Lists changes; `is_named` adds a column for scene and filter.
fn change_table<'a>(
    title: &str,
    is_named: bool,
    changes: impl Iterator<Item = &'a Change>,
) -> Markup {
    let rows = html! {
        @for change in changes {
            @let cells = ChangeCells::from(change);
            tr {
                @if is_named { th scope="row" { (change.scene) " / " (change.filter) } }
                th.text scope="row" { (change.metric) }
                td data-label="first" { (cells.first) }
                td data-label="second" { (cells.second) }
                td class=(change_class(change.kind)) { (cells.change) }
                td data-label="95 % CI" { (cells.interval) }
            }
        }
    };
    let columns = [
        Text("metric"),
        Plain("first"),
        Plain("second"),
        Text("change"),
        Plain("95 % CI"),
    ];
    let named = is_named.then_some(Plain("scene / filter"));
    let columns: Vec<_> = named.into_iter().chain(columns).collect();
    scroll_table(Some("stacked"), title, None, &columns, &rows)
}

fn change_class(kind: ChangeKind) -> &'static str {
    match kind {
        ChangeKind::Better => "change better",
        ChangeKind::Worse => "change worse",
        _ => "change",
    }
}

/// Draws a mean change with its interval; no change is in the middle.
fn change_strip(mean: &MeanChange, most: f64) -> Markup {
    let strip = Strip::about_zero(most);
    let class = if mean.worse > 0.0 { "worse" } else { "" };
    strip.draw(&html! {
        (strip.tick(0.0))
        (strip.interval(mean.interval))
        (strip.mark(mean.worse, class))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scores_of_one_unit_share_a_scale() {
        let change = |metric: Metric, worse: f64| MeanChange {
            filter: "blur:default".to_owned(),
            metric,
            scenes: 5,
            better_worse: [0, 0],
            first: 0.0,
            second: worse,
            worse,
            interval: [worse - 0.25, worse],
            kind: ChangeKind::Worse,
        };
        let (growth, loss) = (change(Metric::GROWTH, 0.5), change(Metric::LOSS, 2.0));
        let (flip, psnr) = (change(Metric::FLIP, 0.125), change(Metric::PSNR, 9.0));
        let all = [&growth, &loss, &flip, &psnr];
        let scales = all.map(|mean| largest_of_kind(&all, mean.metric));
        assert_eq!(scales, [2.0, 2.0, 0.125, 9.0]);
    }
}
