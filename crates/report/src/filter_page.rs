//! Section of a filter: description, source, cost, parameters, and the scenes where it is weakest.

use filters::{Filter, Source};
use maud::{Markup, html};
use measure::{Case, FilterId};
use metrics::Metric;

use crate::addition::columns;
use crate::address::{case_anchor, section_anchor};
use crate::case_table::CaseTable;
use crate::numbers::value_text;
use crate::overview::Overview;
use crate::table::Column::{Plain, Text};
use crate::table::{Column, scroll_table};

/// Scores next to the error in the table of scenes.
const SCORES: [(Metric, &str); 8] = [
    (Metric::FLIP, "FLIP"),
    (Metric::STILL, "still"),
    (Metric::GRAIN, "grain"),
    (Metric::SKILL, "skill"),
    (Metric::GROWTH, "growth"),
    (Metric::LOSS, "loss"),
    (Metric::Bleed, "bleed"),
    (Metric::PSNR, "PSNR"),
];

/// Writes the section of a filter.
pub fn filter_section(overview: &Overview, filter: &FilterId) -> Markup {
    let table = overview.table;
    let cases: Vec<&Case> = table.cases_of(filter).map(|(_, case)| case).collect();
    let Some(first) = cases.first() else {
        return html! {};
    };
    // A folder of the same name with other parameters is not the built-in filter.
    let builtin = Filter::builtin(&first.filter).ok();
    let builtin = builtin.filter(|builtin| {
        builtin
            .parameters
            .iter()
            .all(|parameter| first.parameters.contains_key(&parameter.name))
    });
    html! {
        article.filter id=(section_anchor(filter)) data-title=(filter.name) {
            noscript {
                div.case_head {
                    h2 tabindex="-1" { (filter.name) }
                    nav.neighbours { a href="#overview" data-key="o" { "Overview" } }
                }
                @if let Some(builtin) = &builtin { p.lead { (builtin.summary) } }
                dl.facts {
                    @if let Some(builtin) = &builtin { (about(builtin, first)) }
                    div { dt { "shutter" } dd { (filter.alignment) } }
                    @for column in columns(overview.additions) {
                        div { dt { (column.name) } dd { (column.text(filter)) " " (column.unit) } }
                    }
                    @if let Some(change) = first.input.change() { div { dt { "input" } dd { (change) } } }
                    @if let Some(command) = &first.command { div { dt { "command" } dd { code { (command.join(" ")) } } } }
                }
                (weakest(table, &cases, overview.thumbnails))
                (parameters(builtin.as_ref(), first))
            }
        }
    }
}

/// Describes a built-in filter and the preset of a case.
fn about(filter: &Filter, case: &Case) -> Markup {
    let preset = filter
        .presets
        .iter()
        .find(|preset| preset.name == case.preset);
    html! {
        @if let Some(preset) = preset { div { dt { "preset" } dd { (preset.doc) } } }
        div { dt { "published" } dd { (filter.source) } }
        @if let Some(source) = preset.and_then(|preset| preset.source.as_ref()) { (source_rows(source)) }
        div { dt { "reach" } dd { (filter.reach) } }
        div { dt { "limits" } dd { (filter.cannot) } }
    }
}

fn source_rows(source: &Source) -> Markup {
    html! {
        @if let Some(publication) = &source.publication { div { dt { "follows" } dd { (publication) } } }
        @if let Some(code) = &source.code { div { dt { "code" } dd { (code.repository) " at " code { (code.commit) } } } }
        @if !source.differs.is_empty() { div { dt { "differences" } dd { (source.differs.join(" ")) } } }
    }
}

/// Lists the scenes, largest error first, each with a link to its case.
fn weakest(table: &CaseTable, cases: &[&Case], thumbnails: &[String]) -> Markup {
    let error = |case: &Case| case.estimate(Metric::FLIP).unwrap_or(f64::NEG_INFINITY);
    let mut sorted = cases.to_vec();
    sorted.sort_by(|a, b| error(b).total_cmp(&error(a)));
    let mut columns = vec![Column::Plain("scene")];
    columns.extend(SCORES.map(|(_, title)| Column::Plain(title)));
    columns.push(Column::Text("what the scene exposes"));
    let rows = html! {
        @for case in sorted {
            @let place = table.scenes.iter().position(|scene| **scene == case.scene);
            tr {
                th scope="row" {
                    a.scene href=(format!("#{}", case_anchor(case))) {
                        img data-thumbnail=[place.filter(|at| *at < thumbnails.len())] alt="";
                        (case.scene)
                    }
                }
                @for (metric, title) in SCORES { td data-label=(title) { (case.score_text(metric)) } }
                td.text { (case.exposes) }
            }
        }
    };
    scroll_table(
        Some("stacked"),
        "Scenes",
        Some("Scenes, the weakest first"),
        &columns,
        &rows,
    )
}

fn parameters(filter: Option<&Filter>, case: &Case) -> Markup {
    let doc = |name: &str| {
        let mut all = filter?.parameters.iter();
        all.find(|parameter| parameter.name == name)
            .map(|parameter| parameter.doc.as_str())
    };
    let rows = html! {
        @for (name, value) in &case.parameters {
            tr { th scope="row" { (name) } td { (value_text(value)) } td.text { (doc(name).unwrap_or_default()) } }
        }
    };
    html! {
        @if !case.parameters.is_empty() {
            (scroll_table(Some("stacked"), "Parameters", Some("Parameters"), &[
                Plain("parameter"), Plain("value"), Text("meaning"),
            ], &rows))
        }
    }
}
