//! Section of a case: one filter on one scene.

pub mod bounds;
pub mod case_view;
mod evidence;
pub mod legend;
mod profile;
mod profile_chart;
mod scores;
pub mod viewer;

use maud::{Markup, html};

use crate::filter_id::{FilterId, list_scenes};
use crate::run_facts::provenance_line;
use bounds::bounds;
use case_view::CaseView;
use profile::Profile;
use profile_chart::profile_chart;
use scores::score_rows;
use suite::Case;

/// Writes a case; it is seen while it is open, and the script brings the viewer.
pub fn case_section(page: &CaseView) -> Markup {
    let case = page.case;
    let title = format!("{} / {}", case.scene, FilterId::of(case).title());
    html! {
        article.case id=(format!("case-{}", page.index)) data-title=(title) {
            (neighbours(page))
            h2 tabindex="-1" { (title) }
            p.lead { (case.exposes) }
            div.viewer_place data-scene=(page.scene) data-layers=(layers(page)) data-stops=(page.stops)
                data-names=(serde_json::json!(page.names)) data-line=(line(&page.profile)) {}
            section {
                h3 { "Along the motion, through the worst place" }
                (profile_chart(&page.profile))
            }
            div.columns {
                (bounds(page))
                (facts(case))
            }
            (score_rows(page))
            p.note { (provenance_line(page.run)) }
        }
    }
}

/// `truth:3,4,5 .. objects:17`: the numbers of the planes.
fn layers(page: &CaseView) -> String {
    let word = |name: &str, planes: &[usize]| {
        let planes: Vec<String> = planes.iter().map(usize::to_string).collect();
        format!("{name}:{}", planes.join(","))
    };
    let mut words: Vec<String> = (page.layers.iter())
        .map(|(layer, planes)| word(layer.name(), planes))
        .collect();
    words.push(word("objects", &[page.objects]));
    words.join(" ")
}

/// The profile's line as a path over the picture, with a ring around its place.
fn line(profile: &Profile) -> String {
    let [x, y] = profile.place.map(|axis| axis as f32 + 0.5);
    let end = |distance: Option<&f32>| {
        let distance = distance.copied().unwrap_or(0.0);
        let [right, down] = profile.direction.map(|axis| axis * distance);
        format!("{:.1} {:.1}", x + right, y + down)
    };
    format!(
        "M{} L{} M{:.1} {y:.1} a3 3 0 1 0 6 0 a3 3 0 1 0 -6 0",
        end(profile.distances.first()),
        end(profile.distances.last()),
        x - 3.0
    )
}

/// The ways to the overview, to other filters of the scene, and to the same filter in other scenes.
fn neighbours(page: &CaseView) -> Markup {
    let (run, index) = (page.run, page.index);
    let scene = |index: usize| run.cases[index].scene.as_str();
    let scenes = list_scenes(run);
    let place = (scenes.iter()).position(|own| *own == scene(index));
    let place = place.expect("a case's scene is one of the run's");
    let filter = FilterId::of(page.case);
    let in_scene = |at: Option<usize>| filter.case_on(run, scenes.get(at?)?);
    let of_scene =
        |at: Option<usize>| at.filter(|at| *at < run.cases.len() && scene(*at) == scene(index));
    let ways = [
        ("h", "← scene", in_scene(place.checked_sub(1))),
        ("l", "scene →", in_scene(Some(place + 1))),
        ("k", "↑ filter", of_scene(index.checked_sub(1))),
        ("j", "↓ filter", of_scene(Some(index + 1))),
    ];
    html! {
        nav.neighbours aria-label="Cases" {
            a data-key="o" href="#overview" { "Overview" }
            @for (key, words, to) in ways {
                @match to {
                    Some(to) => a data-key=(key) href=(format!("#case-{to}")) { (words) },
                    None => span.none aria-hidden="true" { (words) },
                }
            }
        }
    }
}

fn facts(case: &Case) -> Markup {
    html! {
        section.facts {
            h3 { "Case" }
            dl {
                div { dt { "family" } dd { (case.family.name()) } }
                div { dt { "exposure" } dd { (case.exposure) " frames, " (case.alignment) } }
                div { dt { "truth" } dd { code { (case.truth_hash) } } }
                @if let Some(change) = case.input.change() { div { dt { "input" } dd { (change) } } }
                @if let Some(command) = &case.command {
                    div { dt { "command" } dd { code { (command.join(" ")) } } }
                }
                @if let Some(width) = case.reference_width {
                    div { dt { "values in pixels" } dd { "scaled from pictures " (width) " pixels wide" } }
                }
                @for (name, value) in &case.parameters {
                    div { dt { (name) } dd { (value) } }
                }
            }
        }
    }
}
