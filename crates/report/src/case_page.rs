//! One filter on one scene.

use std::path::Path;

use maud::{Markup, html};

use super::evidence::{Evidence, evidence};
use super::layer::Layer;
use super::profile::{Profile, profile, worst_pixel};
use super::profile_chart::profile_chart;
use super::provenance::provenance_line;
use super::scene_files::SceneFiles;
use super::score_rows::score_rows;
use super::subject::{Subject, case_of, scenes};
use super::verdicts::verdicts;
use suite::{BLOCK, Finding, worst_block};
use suite::{Case, Error, Run};

/// A case with what a page shows of its files.
pub struct Page<'a> {
    /// The run that it is of.
    pub run: &'a Run,
    /// Its number in the run.
    pub index: usize,
    /// What was measured.
    pub case: &'a Case,
    /// One per bound; none where the run was not judged.
    pub findings: Vec<Finding>,
    /// Per finding where to look; none where it needs no explanation.
    pub evidence: Vec<Option<Evidence>>,
    /// The scene's number in the run.
    pub scene: usize,
    /// Every picture that there is, with the numbers of its planes on the scene's shelf.
    pub layers: Vec<(Layer, Vec<usize>)>,
    /// The plane of the objects' indices.
    pub objects: usize,
    /// What these are called.
    pub names: Vec<String>,
    /// Display exposure of the scene, in stops.
    pub stops: f32,
    /// Through the worst place.
    pub profile: Profile,
}

/// Which of a run's cases to read, and what is known of it.
pub struct Which<'a> {
    /// The run.
    pub run: &'a Run,
    /// Its number in the run.
    pub index: usize,
    /// One per bound.
    pub findings: Vec<Finding>,
    /// The scene's number in the run.
    pub scene: usize,
}

impl<'a> Page<'a> {
    /// Reads a case's files below `folder`.
    pub fn read(which: Which<'a>, folder: &Path, files: &mut SceneFiles) -> Result<Self, Error> {
        let Which {
            run,
            index,
            findings,
            scene,
        } = which;
        let case = &run.cases[index];
        let own = files.case(case, folder)?;
        let evidence: Vec<Option<Evidence>> = (findings.iter())
            .map(|finding| evidence(finding, case, &own, files))
            .collect::<Result<_, _>>()?;
        let flip = own.errors.plane("flip")?;
        let place = match evidence.iter().flatten().next() {
            Some(first) => worst_pixel(&own.errors.plane(&first.map)?, first.place, BLOCK),
            None => {
                let metric = "flip_moving".parse().expect("a metric's name");
                let (x, y) = worst_block(metric, &flip, &files.truths[&case.alignment].regions);
                worst_pixel(&flip, [x, y], BLOCK)
            }
        };
        Ok(Self {
            profile: profile(place, case, files, &own),
            names: files.frame.objects.clone(),
            stops: files.frame.display.stops,
            layers: own.layers,
            objects: own.objects,
            run,
            index,
            case,
            findings,
            evidence,
            scene,
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
            div.viewer_place data-scene=(page.scene) data-layers=(layers(page)) data-stops=(page.stops)
                data-names=(serde_json::json!(page.names)) data-line=(line(&page.profile)) {}
            section {
                h3 { "Along the motion, through the worst place" }
                (profile_chart(&page.profile))
            }
            div.columns {
                (verdicts(page))
                (facts(case))
            }
            (score_rows(page))
            p.note { (provenance_line(page.run)) }
        }
    }
}

/// `truth:3,4,5 .. objects:17`: the numbers of the planes.
fn layers(page: &Page) -> String {
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
