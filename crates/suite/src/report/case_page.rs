//! One filter on one scene.

use std::path::Path;

use maud::{Markup, html};

use super::gallery::Gallery;
use super::layer::Layer;
use super::score_rows::score_rows;
use super::subject::{Subject, case_of, scenes};
use super::verdicts::verdicts;
use crate::gate::Finding;
use crate::{Case, Error, Run};

/// A case with its pictures read.
pub struct Page<'a> {
    /// The run that it is of.
    pub run: &'a Run,
    /// Its number in the run.
    pub index: usize,
    /// What was measured.
    pub case: &'a Case,
    /// One per bound, in the order of the case's verdicts.
    pub findings: Vec<Finding>,
    /// Per finding the number of its picture of the worst place.
    pub crops: Vec<Option<usize>>,
    /// The number of each picture, in the order of [`Layer::ALL`].
    pub layers: [usize; Layer::ALL.len()],
}

impl<'a> Page<'a> {
    /// Reads a case's pictures below `folder`.
    pub fn read(
        run: &'a Run,
        index: usize,
        findings: Vec<Finding>,
        folder: &Path,
        gallery: &mut Gallery,
    ) -> Result<Self, Error> {
        let case = &run.cases[index];
        let mut layers = [0; Layer::ALL.len()];
        for (number, layer) in layers.iter_mut().zip(Layer::ALL) {
            *number = gallery.add(&layer.file(case, folder))?;
        }
        let crops = (findings.iter())
            .map(|finding| match &finding.worst {
                Some(worst) => gallery.add(&folder.join(&worst.picture)).map(Some),
                None => Ok(None),
            })
            .collect::<Result<_, _>>()?;
        Ok(Self {
            run,
            index,
            case,
            findings,
            crops,
            layers,
        })
    }
}

/// Seen while it is open; the script brings the viewer.
pub fn case_page(page: &Page) -> Markup {
    let case = page.case;
    let title = format!("{} / {}", case.scene, Subject::of(case).title());
    html! {
        article.case id=(format!("case-{}", page.index)) data-title=(title) {
            (neighbours(page))
            h2 tabindex="-1" { (title) }
            p.lead { "This scene exposes: " (case.exposes) }
            div.viewer_place data-layers=(layers(page)) {}
            div.columns {
                (verdicts(page))
                (facts(case))
            }
            (score_rows(case))
        }
    }
}

/// `truth:3 output:17 ..`: the numbers of the pictures.
fn layers(page: &Page) -> String {
    let words: Vec<String> = (Layer::ALL.iter().zip(page.layers))
        .map(|(layer, number)| format!("{}:{number}", layer.name()))
        .collect();
    words.join(" ")
}

/// The ways to the overview, to other filters of the scene, and to the same filter in other scenes.
fn neighbours(page: &Page) -> Markup {
    let (run, index) = (page.run, page.index);
    let scene = |index: usize| run.cases[index].scene.as_str();
    let scenes = scenes(run);
    let place = (scenes.iter()).position(|own| *own == scene(index));
    let place = place.expect("a case's scene is one of the run's");
    let subject = Subject::of(page.case);
    let in_scene =
        |at: Option<usize>| case_of(run, &subject, scenes.get(at?).copied().unwrap_or_default());
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
                @for (name, value) in &case.parameters {
                    div { dt { (name) } dd { (value) } }
                }
            }
        }
    }
}
