//! Table of one score: filters, best mean first, against scenes.

use maud::{Markup, html};
use metrics::{Ideal, Metric};

use super::cell::{Colors, cell};
use super::costs::{cost_of, cost_text};
use super::headlines::TableScore;
use crate::case::case_view::CaseView;
use crate::case_table::CaseTable;
use crate::charts::strip::Strip;
use crate::filter_id::{list_alignments, mean, mean_floor, section_anchor};
use suite::{Bench, Case, FilterId, Level, Outcome, Overall, list_summarized};
use tracer::FrameRate;

/// Lengths of the middle half of the means that the scale goes on beyond it; what lies farther is drawn as an arrow.
const WHISKERS: f64 = 1.5;

/// Scenes from which on their columns are narrow.
const MANY: usize = 8;

/// A row before it is drawn.
struct Row<'a> {
    /// Filter or reference.
    filter: FilterId,
    /// Mean over scenes with its interval; none with a single scene.
    overall: Option<&'a Overall>,
    /// Mean, or the only score.
    mean: Option<f64>,
}

/// Groups the filters of a run by shutter, unless the score compares across shutters; the best mean comes first.
fn rank_rows<'a>(table: &CaseTable<'a>, metric: Metric) -> Vec<Vec<Row<'a>>> {
    // Shutters come in the order of their filters, as in every ranking, and references behind the filters.
    let mut filters = table.filters.clone();
    filters.sort_by_key(|filter| filter.is_reference);
    let rate = summarized_rate(&table.run.cases);
    let means: Vec<&Overall> = (table.run.overall.iter())
        .filter(|own| own.metric == metric && Some(own.rate) == rate)
        .collect();
    let row = |filter: &FilterId| {
        let overall = means.iter().find(|own| own.filter_id() == *filter).copied();
        let of_rate = |case: &Case| rate.is_none_or(|rate| case.rate == rate);
        let scores = (table.cases_of(filter)).filter(|(_, case)| of_rate(case));
        let only = mean(scores.filter_map(|(_, case)| case.estimate(metric)));
        Row {
            overall,
            mean: overall.map(|own| own.mean).or(only),
            filter: filter.clone(),
        }
    };
    let mut groups: Vec<Vec<Row>> = match metric.spans_alignments() {
        true => vec![filters.iter().map(row).collect()],
        false => (list_alignments(&filters).into_iter())
            .map(|own| {
                filters
                    .iter()
                    .filter(|filter| filter.alignment == own)
                    .map(row)
                    .collect()
            })
            .collect(),
    };
    let badness = |row: &Row| {
        row.mean
            .map_or(f64::INFINITY, |own| metric.ideal().badness(own))
    };
    for group in &mut groups {
        group.sort_by(|a, b| badness(a).total_cmp(&badness(b)));
    }
    groups
}

/// Writes the table; a table without means, that of a single scene, has no column for them.
pub fn score_table(
    table: &CaseTable,
    views: &[CaseView],
    thumbnails: &[String],
    score: &TableScore,
    bench: Option<&Bench>,
) -> Markup {
    let metric = score.metric;
    let scenes = &table.scenes;
    let groups = rank_rows(table, metric);
    let rows = || groups.iter().flatten();
    let own = views.iter().filter(|view| !view.case.is_reference);
    let colors = Colors::over(
        metric.ideal(),
        own.filter_map(|view| view.case.estimate(metric)),
    );
    let has_means = rows().any(|row| row.overall.is_some());
    let strip = strip_over(
        rows().filter(|row| !row.filter.is_reference),
        metric.ideal(),
    );
    let columns = 1 + scenes.len() + 3 * usize::from(has_means) + usize::from(bench.is_some());
    // What a reader looks for comes first.
    let order = match metric.ideal() {
        Ideal::Highest => "descending",
        Ideal::Lowest | Ideal::Target(_) => "ascending",
    };
    html! {
        div.scroll tabindex="0" role="region" aria-label=(format!("{} of every case", score.title)) {
            table.sortable.many[scenes.len() > MANY] data-first=(order) {
                caption { (caption(metric, has_means, scenes.len())) }
                thead {
                    tr {
                        th scope="col" { button { "filter" } }
                        @if has_means {
                            th scope="col" { button { "mean" } }
                            th.note scope="col" { "95 % CI" }
                            th.chart scope="col" {
                                div.ends { span { (metric.number(strip.low)) } span.unseen { " to " } span { (metric.number(strip.high)) } }
                            }
                        }
                        @for (scene, picture) in scenes.iter().zip(thumbnails) {
                            th.scene scope="col" {
                                img src=[Some(picture).filter(|own| !own.is_empty())] alt="";
                                button { (breakable(&scene.to_string())) }
                            }
                        }
                        @if bench.is_some() { th scope="col" { button { "cost, ms" } } }
                    }
                }
                @for group in &groups {
                    @if !metric.spans_alignments() {
                        tbody.group {
                            tr { th scope="rowgroup" colspan=(columns) { (group[0].filter.alignment) " shutter" } }
                        }
                    }
                    tbody {
                        @for row in group {
                            tr.reference[row.filter.is_reference] data-failing[is_failing(table, views, &row.filter)] {
                                th scope="row" { (name(metric, &row.filter)) }
                                @if has_means { (mean_cells(table, metric, &strip, row)) }
                                @for scene in scenes {
                                    @match table.case_on(&row.filter, scene) {
                                        Some(index) => (cell(metric, &colors, &views[index])),
                                        None => td { "-" },
                                    }
                                }
                                @if bench.is_some() { (cost(table, bench, &row.filter)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn caption(metric: Metric, has_means: bool, scenes: usize) -> &'static str {
    match (has_means, metric.spans_alignments()) {
        (false, _) if scenes > 1 => "Counts of sub-frames have no mean",
        (false, _) => "A single scene has no mean",
        (true, true) => {
            "Best mean over scenes first, filters of all shutters. Line: 95 % CI over scenes; grey: noise floor of the truth"
        }
        (true, false) => {
            "Best mean over scenes first. Line: 95 % CI over scenes; grey: noise floor of the truth. Compare filters of one shutter only"
        }
    }
}

/// Finds the frame rate whose means are shown: that of the scenes' files, or the only one; none where there are several others.
fn summarized_rate(cases: &[Case]) -> Option<Option<FrameRate>> {
    let cases = list_summarized(cases);
    let first = cases.first().map(|case| case.rate);
    first.filter(|rate| cases.iter().all(|case| case.rate == *rate))
}

/// Tells whether any required bound on a filter's scores is broken.
fn is_failing(table: &CaseTable, views: &[CaseView], filter: &FilterId) -> bool {
    let mut findings = table
        .cases_of(filter)
        .flat_map(|(index, _)| &views[index].findings);
    findings.any(|own| own.level == Level::Required && own.outcome == Outcome::Broken)
}

/// Links a filter to its section.
fn name(metric: Metric, filter: &FilterId) -> Markup {
    html! {
        @if filter.is_reference { (filter.name) }
        @else { a href=(format!("#{}", section_anchor(filter))) { (breakable(&filter.name)) } }
        @if metric.spans_alignments() { " " span.note { "(" (filter.alignment) ")" } }
    }
}

/// Writes a name that may break behind every word.
fn breakable(name: &str) -> Markup {
    html! {
        @for part in name.split_inclusive(['_', ':']) { (part) wbr; }
    }
}

fn mean_cells(table: &CaseTable, metric: Metric, strip: &Strip, row: &Row) -> Markup {
    let Some(own) = row.overall else {
        return html! { td { "-" } td {} td {} };
    };
    let class = if own.is_reference { "open" } else { "" };
    // Only where less is better does a floor lie between perfect and the score.
    let floor = match metric.ideal() {
        Ideal::Lowest => mean_floor(table, &row.filter, metric),
        Ideal::Highest | Ideal::Target(_) => None,
    };
    let [low, high] = own.interval.map(|end| metric.number(end));
    html! {
        td.mean data-value=(own.mean) { (metric.number(own.mean)) }
        td.note { (low) " to " (high) }
        td.chart {
            (strip.draw(&html! {
                @if let Some(floor) = floor { (strip.bar(0.0, floor, "floor")) }
                (strip.interval(own.interval))
                (strip.mark(own.mean, class))
            }))
        }
    }
}

/// Makes a scale from perfect, where that is known, over all means but outliers.
fn strip_over<'a>(rows: impl Iterator<Item = &'a Row<'a>>, ideal: Ideal) -> Strip {
    let mut means: Vec<f64> = rows
        .filter_map(|row| row.mean)
        .filter(|own| own.is_finite())
        .collect();
    means.sort_by(f64::total_cmp);
    let perfect = match ideal {
        Ideal::Lowest => Some(0.0),
        Ideal::Target(target) => Some(target),
        Ideal::Highest => None,
    };
    let last = means.len().saturating_sub(1);
    let quartiles = match means.is_empty() {
        true => [0.0, 1.0],
        false => [means[last / 4], means[last - last / 4]],
    };
    let room = WHISKERS * (quartiles[1] - quartiles[0]);
    let within = |own: &f64| (quartiles[0] - room..=quartiles[1] + room).contains(own);
    Strip::over(means.into_iter().filter(within).chain(perfect))
}

/// Writes the cost of a filter, which sorts as the scores do.
fn cost(table: &CaseTable, bench: Option<&Bench>, filter: &FilterId) -> Markup {
    let cost = cost_of(table, bench, filter);
    html! { td.cost data-value=[cost.map(|own| own.seconds.median)] { (cost_text(cost)) } }
}
