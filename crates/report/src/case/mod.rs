//! Section of a case: one filter on one scene.

pub mod bounds;
pub mod case_view;
pub mod legend;
pub mod profile;
mod profile_chart;
mod scores;
pub mod viewer;

use bounds::bounds;
use case_view::CaseView;
use judge::Level;
use maud::{Markup, html};
use measure::{Case, Drawn};
use metrics::Metric;
use profile::Profile;
use profile_chart::profile_chart;
use scores::score_rows;

use crate::address::{anchor, case_anchor, section_anchor};
use crate::case_table::CaseTable;
use crate::finding_text::Tally;
use crate::live::Live;
use crate::numbers::{counted, value_text};
use crate::pixels::scene_files::find_traced;
use crate::run_facts::{provenance_line, truth_text};

/// Tables of a case: above its pictures, and below them.
pub struct CaseTables {
    head: Markup,
    rest: Markup,
}

impl CaseTables {
    /// Writes the tables.
    pub fn new(view: &CaseView, table: &CaseTable) -> Self {
        let case = view.case;
        let filter = case.filter_id();
        let head = html! {
            div.case_head {
                h2 tabindex="-1" {
                    (case.scene) " / "
                    @if filter.is_reference { (filter) }
                    @else { a href=(format!("#{}", section_anchor(&filter))) { (filter) } }
                }
                (neighbours(view, table))
            }
            (score_line(view, table))
        };
        let rest = html! {
            p { (case.exposes) }
            div.columns {
                div {
                    section {
                        h3 { "Along the motion, through the worst place" }
                        (profile_chart(&view.profile))
                    }
                    (bounds(view))
                }
                (facts(view))
            }
            (score_rows(view))
            p.note { (provenance_line(view.run)) }
        };
        Self { head, rest }
    }

    /// Returns both texts for a file next to the page, by the address of the case.
    pub fn texts(self, case: &Case) -> (String, [String; 2]) {
        let Self { head, rest } = self;
        (case_anchor(case), [head, rest].map(Markup::into_string))
    }
}

/// Writes a case, which is visible while open; the script adds the viewer. If scripts run, the
/// tables are text until the case is open, since a browser needs seconds for all cases' tables.
/// Without `tables` the script loads them from a file next to the page.
pub fn case_section(view: &CaseView, live: Option<&Live>, tables: Option<&CaseTables>) -> Markup {
    let case = view.case;
    let filter = case.filter_id();
    let title = format!("{} / {}", case.scene, filter);
    let [x, y] = view.profile.place;
    html! {
        article.case id=(case_anchor(case)) data-title=(title) data-name=(anchor(&filter))
            data-filter=(filter) data-reference[filter.is_reference]
            data-score=(format!("FLIP {}", case.score_text(Metric::FLIP))) {
            (part(tables.map(|table| &table.head)))
            div.viewer_place data-truth=[case.drawn.as_ref().map(truth_words)] data-scene=(view.scene) data-layers=(layers(view)) data-stops=(view.stops)
                data-names=(serde_json::json!(view.names)) data-line=(line(&view.profile)) data-worst=(format!("{x},{y}")) {}
            (live_place(live))
            (part(tables.map(|table| &table.rest)))
        }
    }
}

/// Writes the place of the panel that runs the filter, which the script shows, or why there is
/// none.
fn live_place(live: Option<&Live>) -> Markup {
    html! {
        @match live {
            Some(Live::Case(data)) => div.live hidden data-live=(data) { button type="button" { "Try it" } },
            Some(Live::Not(reason)) => p.note.live_not { (reason) },
            None => {},
        }
    }
}

/// Writes tables, or a placeholder.
fn part(tables: Option<&Markup>) -> Markup {
    html! {
        @match tables {
            Some(tables) => noscript { (tables) },
            None => div.part {},
        }
    }
}

/// Writes the scores that a reader looks for first, and the rank among the filters of one shutter.
fn score_line(view: &CaseView, table: &CaseTable) -> Markup {
    let case = view.case;
    let (place, of) = place_on_scene(table, case);
    let [bounds, targets] =
        [Level::Required, Level::Report].map(|level| Tally::of(&view.findings, level));
    html! {
        p.score {
            @for (metric, name) in [(Metric::FLIP, "FLIP"), (Metric::SKILL, "skill"), (Metric::PSNR, "PSNR")] {
                @if let Some(value) = case.estimate(metric) {
                    span { (name) " " strong { (metric.number(value)) } (interval(case, metric)) }
                }
            }
            @if let (false, Some(place)) = (case.is_reference, place) {
                span { "place " strong { (place) } " of " (of) " with a " (case.alignment) " shutter" }
            }
            @if bounds.all > 0 {
                span class=(if bounds.broken > 0 { "broken" } else { "met" }) { (bounds.broken) " of " (counted(bounds.all, "required bound")) " broken" }
            }
            @if targets.all > 0 { span { (targets.broken) " of " (counted(targets.all, "target")) " missed" } }
        }
    }
}

/// ` (95 % CI 0.052 to 0.061)`
fn interval(case: &Case, metric: Metric) -> String {
    case.interval(metric).map_or_else(String::new, |interval| {
        let [low, high] = [interval.low, interval.high].map(|end| metric.number(end));
        format!(" (95 % CI {low} to {high})")
    })
}

/// Counts the scene's filters with the same shutter: those with better FLIP, and all.
fn place_on_scene(table: &CaseTable, case: &Case) -> (Option<usize>, usize) {
    let flip = |case: &Case| case.estimate(Metric::FLIP);
    let rivals = (table.cases_on(&case.scene).map(|(_, rival)| rival))
        .filter(|rival| !rival.is_reference && rival.alignment == case.alignment);
    let errors: Vec<f64> = rivals.filter_map(flip).collect();
    let place = flip(case).map(|value| 1 + errors.iter().filter(|error| **error < value).count());
    (place, errors.len())
}

/// `truth:3,4,5 .. objects:17`: the numbers of the planes.
fn layers(view: &CaseView) -> String {
    let word = |name: &str, planes: &[usize]| {
        let planes: Vec<String> = planes.iter().map(usize::to_string).collect();
        format!("{name}:{}", planes.join(","))
    };
    let mut words: Vec<String> = (view.layers.iter())
        .map(|(layer, planes)| word(layer.name(), planes))
        .collect();
    words.push(word("objects", &[view.objects]));
    words.join(" ")
}

/// Writes the profile's line as a path over the picture, with a ring around its place.
fn line(profile: &Profile) -> String {
    let [x, y] = profile.place.map(|axis| axis as f32 + 0.5);
    let [first, last] = profile.ends.map(|[x, y]| format!("{x:.1} {y:.1}"));
    let left = x - 3.0;
    format!("M{first} L{last} M{left:.1} {y:.1} a3 3 0 1 0 6 0 a3 3 0 1 0 -6 0")
}

/// Links to the overview, to other filters of the scene, and to the same filter in other scenes.
fn neighbours(view: &CaseView, table: &CaseTable) -> Markup {
    let (run, index) = (view.run, view.index);
    let scene = |index: usize| &run.cases[index].scene;
    let filter = view.case.filter_id();
    let in_scene = |at: Option<usize>| table.case_on(&filter, table.scenes.get(at?)?);
    let of_scene =
        |at: Option<usize>| at.filter(|at| *at < run.cases.len() && scene(*at) == scene(index));
    let ways = [
        ("h", "← scene", in_scene(view.scene.checked_sub(1))),
        ("l", "scene →", in_scene(Some(view.scene + 1))),
        ("k", "↑ filter", of_scene(index.checked_sub(1))),
        ("j", "↓ filter", of_scene(Some(index + 1))),
    ];
    html! {
        nav.neighbours aria-label="Cases" {
            a data-key="o" href="#overview" { "Overview" }
            @for (key, words, to) in ways {
                @match to {
                    Some(to) => a data-key=(key) href=(format!("#{}", case_anchor(&run.cases[to]))) { (words) },
                    None => span.none aria-hidden="true" { (words) },
                }
            }
        }
    }
}

/// Title and hint of an engine's truth, in the script's format.
fn truth_words(drawn: &Drawn) -> String {
    let hint = format!("{}: scores are against it", drawn.truth_text());
    serde_json::json!({ "title": "Engine's truth", "hint": hint }).to_string()
}

/// Describes whose truth a case is scored against, and where ours is, if an engine drew the scene.
fn truth_facts(view: &CaseView) -> Markup {
    let traced = find_traced(view.run, view.case);
    html! {
        div {
            dt { "truth" }
            dd {
                (truth_text(view.case)) ", "
                code { (view.case.truth_hash) }
            }
        }
        @if let Some(drawn) = &view.case.drawn {
            @if drawn.step > 0.0 {
                div {
                    dt { "steps of the truth" }
                    dd { "99 % of what moves goes at most " (format!("{:.2}", drawn.step)) " px between two sub-frames" }
                }
            }
            div {
                dt { "our truth" }
                dd {
                    @match (&drawn.scene, traced) {
                        (Some(_), Some(traced)) => {
                            a href=(format!("#{}", case_anchor(traced))) { (traced.scene) } ", path traced; no score of this case is against it"
                        },
                        (Some(scene), None) => { "not in this run: measure " (scene) " in the same run" },
                        (None, _) => "none: the engine drew no scene of ours",
                    }
                }
            }
        }
    }
}

fn facts(view: &CaseView) -> Markup {
    let case = view.case;
    html! {
        section.facts {
            h3 { "Case" }
            dl {
                @if let Some(family) = case.family { div { dt { "family" } dd { (family.name()) } } }
                div { dt { "exposure" } dd { (case.exposure) " frames, " (case.alignment) } }
                (truth_facts(view))
                @if let Some(change) = case.input.change() { div { dt { "input" } dd { (change) } } }
                @if let Some(command) = &case.command {
                    div { dt { "command" } dd { code { (command.join(" ")) } } }
                }
                @if let Some(smear) = &case.smear {
                    div {
                        dt { "smear" }
                        dd {
                            "from " (format!("{:.2} to {:.2}", smear.open, smear.close)) " of the exposure; " (smear.verdict(case.alignment))
                        }
                    }
                }
                @if let Some(width) = case.reference_width {
                    div { dt { "values in pixels" } dd { "scaled from pictures " (width) " pixels wide" } }
                }
                @for (name, value) in &case.parameters {
                    div { dt { (name) } dd { (value_text(value)) } }
                }
            }
        }
    }
}
