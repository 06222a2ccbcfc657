//! Table of one score: filters, best mean first, against scenes.

use judge::{Level, list_summarized};
use maud::{Markup, html};
use measure::{Case, FilterId, Overall};
use metrics::{Ideal, Metric};
use scene::FrameRate;

use super::cell::{Colors, cell};
use crate::addition::{FilterColumn, columns};
use crate::address::section_anchor;
use crate::case::case_view::CaseView;
use crate::case_table::CaseTable;
use crate::charts::strip::Strip;
use crate::finding_text::Tally;
use crate::numbers::mean;
use crate::run_view::RunView;

/// Extent of the scale beyond the middle half of the means, relative to it; means farther out are
/// arrows.
const WHISKERS: f64 = 1.5;

/// Number of scenes at which their columns become narrow.
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

/// Groups the filters of a run by shutter, unless the score compares across shutters; best mean
/// first.
fn rank_rows<'a>(table: &CaseTable<'a>, metric: Metric) -> Vec<Vec<Row<'a>>> {
    // Shutters have the order of their filters, as in every ranking, with references after the
    // filters.
    let mut filters = table.filters.clone();
    filters.sort_by_key(|filter| filter.is_reference);
    let rate = summarized_rate(&table.run.cases);
    let means: Vec<&Overall> = (table.run.overall.iter())
        .filter(|mean| mean.metric == metric && Some(mean.rate) == rate)
        .collect();
    let row = |filter: &FilterId| {
        let overall = means.iter().find(|mean| mean.filter == *filter).copied();
        let of_rate = |case: &Case| rate.is_none_or(|rate| case.rate == rate);
        let scores = (table.cases_of(filter)).filter(|(_, case)| of_rate(case));
        let only = mean(scores.filter_map(|(_, case)| case.estimate(metric)));
        Row {
            overall,
            mean: overall.map(|overall| overall.mean).or(only),
            filter: filter.clone(),
        }
    };
    let mut groups: Vec<Vec<Row>> = Vec::new();
    for row in filters.iter().map(row) {
        let compares = |group: &&mut Vec<Row>| {
            metric.spans_alignments() || group[0].filter.alignment == row.filter.alignment
        };
        match groups.iter_mut().find(compares) {
            Some(group) => group.push(row),
            None => groups.push(vec![row]),
        }
    }
    let badness = |row: &Row| {
        row.mean
            .map_or(f64::INFINITY, |mean| metric.ideal().badness(mean))
    };
    for group in &mut groups {
        group.sort_by(|a, b| badness(a).total_cmp(&badness(b)));
    }
    groups
}

/// A table of one score before it is written.
pub struct ScoreTable<'a> {
    pub view: &'a RunView<'a>,
    pub metric: Metric,
    pub title: &'a str,
    /// Addresses of the scenes' truths above their columns; none for a table without pictures.
    pub thumbnails: &'a [String],
}

impl ScoreTable<'_> {
    /// Writes the table. A single scene has no means, and its table no columns for them.
    pub fn write(&self) -> Markup {
        let RunView { table, cases, .. } = self.view;
        let metric = self.metric;
        let scenes = &table.scenes;
        let ideal = metric.ideal();
        let groups = rank_rows(table, metric);
        let rows = || groups.iter().flatten();
        let measured = cases.iter().filter(|view| !view.case.is_reference);
        let colors = Colors::over(
            ideal,
            measured.filter_map(|view| view.case.estimate(metric)),
        );
        let has_means = rows().any(|row| row.overall.is_some());
        let strip = strip_over(rows().filter(|row| !row.filter.is_reference), ideal);
        let added = columns(self.view.additions).count();
        let width = 1 + scenes.len() + 3 * usize::from(has_means) + added;
        // Best first.
        let order = match ideal {
            Ideal::Highest => "descending",
            Ideal::Lowest | Ideal::Target(_) => "ascending",
        };
        html! {
            div.scroll tabindex="0" role="region" aria-label=(format!("{} of every case", self.title)) {
                table.sortable.many[scenes.len() > MANY] data-first=(order) {
                    caption { (caption(metric, has_means, scenes.len())) }
                    thead { (self.heading(has_means.then(|| ends(metric, &strip)))) }
                    @for group in &groups {
                        @if !metric.spans_alignments() {
                            tbody.group {
                                tr { th scope="rowgroup" colspan=(width) { (group[0].filter.alignment) " shutter" } }
                            }
                        }
                        tbody {
                            @for row in group {
                                tr.reference[row.filter.is_reference] data-failing[is_failing(table, cases, &row.filter)] {
                                    th scope="row" { (name(metric, &row.filter)) }
                                    @if has_means { (mean_cells(table, metric, &strip, row)) }
                                    @for scene in scenes {
                                        @match table.case_on(&row.filter, scene) {
                                            Some(index) => (cell(metric, &colors, &cases[index])),
                                            None => td { "-" },
                                        }
                                    }
                                    @for column in columns(self.view.additions) { (added_cell(column, &row.filter)) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }

    /// Writes the headings of the columns; `ends` of the means' scale are none without means.
    fn heading(&self, ends: Option<Markup>) -> Markup {
        html! {
            tr {
                th scope="col" { button { "filter" } }
                @if let Some(ends) = ends {
                    th scope="col" { button { "mean" } }
                    th.note scope="col" { "95 % CI" }
                    th.chart scope="col" { (ends) }
                }
                @for (index, scene) in self.view.table.scenes.iter().enumerate() {
                    th.scene scope="col" {
                        img src=[self.thumbnails.get(index)] alt="";
                        button { (breakable(&scene.to_string())) }
                    }
                }
                @for column in columns(self.view.additions) {
                    th scope="col" { button { (column.name) ", " (column.unit) } }
                }
            }
        }
    }
}

fn ends(metric: Metric, strip: &Strip) -> Markup {
    html! {
        div.ends { span { (metric.number(strip.low)) } span.unseen { " to " } span { (metric.number(strip.high)) } }
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

/// Finds the frame rate of the displayed means: the scene files' own, or the only one; none if
/// there are several others.
fn summarized_rate(cases: &[Case]) -> Option<Option<FrameRate>> {
    let cases = list_summarized(cases);
    let first = cases.first().map(|case| case.rate);
    first.filter(|rate| cases.iter().all(|case| case.rate == *rate))
}

/// Returns whether any required bound on a filter's scores is broken.
fn is_failing(table: &CaseTable, views: &[CaseView], filter: &FilterId) -> bool {
    let cases = table.cases_of(filter);
    let findings = cases.flat_map(|(index, _)| &views[index].findings);
    Tally::of(findings, Level::Required).broken > 0
}

/// Links a filter to its section.
fn name(metric: Metric, filter: &FilterId) -> Markup {
    html! {
        @if filter.is_reference { (filter.name) }
        @else { a href=(format!("#{}", section_anchor(filter))) { (breakable(&filter.name)) } }
        @if metric.spans_alignments() { " " span.note { "(" (filter.alignment) ")" } }
    }
}

/// Writes a name that may break after every word.
fn breakable(name: &str) -> Markup {
    html! {
        @for part in name.split_inclusive(['_', ':']) { (part) wbr; }
    }
}

fn mean_cells(table: &CaseTable, metric: Metric, strip: &Strip, row: &Row) -> Markup {
    let Some(overall) = row.overall else {
        return html! { td { "-" } td {} td {} };
    };
    let class = if overall.is_reference { "open" } else { "" };
    // A floor is between perfect and the score only if lower is better.
    let floor = match metric.ideal() {
        Ideal::Lowest => {
            let cases = table.cases_of(&row.filter);
            mean(cases.filter_map(|(_, case)| case.floor(metric)))
        }
        Ideal::Highest | Ideal::Target(_) => None,
    };
    let [low, high] = overall.interval.map(|end| metric.number(end));
    html! {
        td.mean data-value=(overall.mean) { (metric.number(overall.mean)) }
        td.note { (low) " to " (high) }
        td.chart {
            (strip.draw(&html! {
                @if let Some(floor) = floor { (strip.bar(0.0, floor, "floor")) }
                (strip.interval(overall.interval))
                (strip.mark(overall.mean, class))
            }))
        }
    }
}

/// Makes a scale from perfect, if that is known, over all means except outliers.
fn strip_over<'a>(rows: impl Iterator<Item = &'a Row<'a>>, ideal: Ideal) -> Strip {
    let mut means: Vec<f64> = rows
        .filter_map(|row| row.mean)
        .filter(|mean| mean.is_finite())
        .collect();
    means.sort_by(f64::total_cmp);
    let perfect = match ideal {
        Ideal::Lowest => Some(0.0),
        Ideal::Target(target) => Some(target),
        Ideal::Highest => None,
    };
    let last = means.len().saturating_sub(1);
    let quartiles = if means.is_empty() {
        [0.0, 1.0]
    } else {
        [means[last / 4], means[last - last / 4]]
    };
    let room = WHISKERS * (quartiles[1] - quartiles[0]);
    let within = |mean: &f64| (quartiles[0] - room..=quartiles[1] + room).contains(mean);
    Strip::over(means.into_iter().filter(within).chain(perfect))
}

/// Writes the number of a filter that another crate adds; it sorts like the scores.
fn added_cell(column: &FilterColumn, filter: &FilterId) -> Markup {
    html! { td class=(column.name) data-value=[column.value(filter)] { (column.text(filter)) } }
}
