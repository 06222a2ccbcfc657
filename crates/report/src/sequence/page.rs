//! Player of sequences.

use std::path::Path;

use judge::{Finding, RANKED_BY};
use maud::{Markup, html};
use measure::{CHANGE_PICTURE, IDENTITY, RenderFile, Run, Sequence, SequenceFrame};
use scene::SceneId;
use serde_json::{Value, json};

use super::ranking::ranking_tables;
use super::scores::score_tables;
use crate::document::{Document, Siblings, script_data};

/// Name of the page, next to run.json: it shows pictures below that folder.
pub const SEQUENCES_PAGE: &str = "sequences.html";

/// Pictures of a frame: the name in attributes, and the title.
const PICTURES: [(&str, &str); 5] = [
    ("instant", "instant"),
    ("truth", "truth"),
    ("output", "output"),
    ("error", "error (FLIP)"),
    ("change", "error of the change"),
];

/// Makes the page that plays the sequences of a run; none if it has none. `findings` are about the
/// run. The page must be in the run's folder, since it loads the pictures there.
pub fn sequences_page(run: &Run, findings: &[Finding]) -> Option<String> {
    if run.sequences.is_empty() {
        return None;
    }
    let played: Vec<Value> = run.sequences.iter().map(play).collect();
    let data = Value::from(played).to_string();
    let mut scenes: Vec<&SceneId> = run
        .sequences
        .iter()
        .map(|sequence| &sequence.scene)
        .collect();
    scenes.dedup();
    let frames = run.frames;
    let document = Document {
        title: "Shuttertruth sequences",
        heading: html! { a href="report.html" { "Shuttertruth" } },
        subtitle: &format!(
            "{}, {} frames of {}x{} at {} per second",
            run.program, frames.count, run.render.width, run.render.height, frames.per_second
        ),
        body: html! {
            main {
                section #overview {
                    noscript { p { "The pictures need scripts; the tables below do not." } }
                    (player(run))
                    (ranking_tables(run, scenes.len()))
                    h2 { "Scores over time" }
                    p.note {
                        "Roots of squared errors, in thousandths of display white; lower is better. JOD as it is; higher is better. "
                        "Filters are ranked by " (RANKED_BY.row().name) ". Italics: references."
                        @if findings.iter().any(Finding::is_of_sequence) {
                            " ✓ bound met; ✗ bound broken; ? too noisy to decide; ~ limit stricter than the noise allows."
                        }
                    }
                    (score_tables(run, findings))
                }
            }
            (script_data("sequences", &data))
        },
        scripts: &[include_str!("../assets/sequence.js")],
        siblings: Siblings::Pictures,
    };
    Some(document.render())
}

/// Writes the controls, and the frames for the pictures.
fn player(run: &Run) -> Markup {
    // The page opens on a filter that blurs.
    let blurs = |sequence: &Sequence| {
        !sequence.is_reference && !sequence.name.starts_with(&format!("{IDENTITY}:"))
    };
    let first_filter = run.sequences.iter().position(blurs).unwrap_or(0);
    let rates = rates(run.frames.per_second);
    html! {
        div.toolbar #player data-rate=(run.frames.per_second) {
            select #sequence aria-label="Sequence" {
                @for (index, sequence) in run.sequences.iter().enumerate() {
                    option value=(index) selected[index == first_filter] { (name(sequence)) }
                }
            }
            button #play type="button" { "Play" }
            button #back type="button" aria-label="Frame before" { "◀" }
            button #on type="button" aria-label="Next frame" { "▶" }
            fieldset.choice {
                legend { "per second" }
                @for (index, rate) in rates.iter().enumerate() {
                    label {
                        input type="radio" name="rate" value=(rate) checked[index == 0];
                        span { (rate) }
                    }
                }
            }
            output #readout {}
        }
        div.sequence #pictures style=(format!("--ratio: {} / {}", run.render.width, run.render.height)) {
            @for (name, title) in PICTURES {
                figure { img id=(format!("picture_{name}")) alt=(title); figcaption { (title) } }
            }
        }
        p.key {
            "Space plays and stops, , and . go frame by frame, 1 to " (rates.len()) " choose the rate, [ and ] the sequence. The \
             error of the change is the difference of the output from the frame before, less that of the truth: black is none."
        }
    }
}

/// Lists the run's own rate, and the usual ones.
fn rates(run_rate: f64) -> Vec<f64> {
    let mut rates = vec![60.0, 30.0, 12.0];
    rates.retain(|rate| *rate != run_rate);
    rates.insert(0, run_rate);
    rates
}

fn name(sequence: &Sequence) -> String {
    format!(
        "{} / {} ({})",
        sequence.scene, sequence.name, sequence.alignment
    )
}

/// Lists the player's data of a sequence. Paths are relative to the page; errors are roots of
/// squares in thousandths of white.
fn play(sequence: &Sequence) -> Value {
    let truth = RenderFile::Truth(sequence.alignment).picture();
    let path = |folder: &Path, name: &str| {
        let path = folder.join(name);
        let parts = path.iter().map(|part| part.to_string_lossy());
        parts.collect::<Vec<_>>().join("/")
    };
    let root = |square: Option<f64>| square.map(|square| 1000.0 * square.max(0.0).sqrt());
    let frame = |(index, frame): (usize, &SequenceFrame)| {
        json!({
            "instant": path(&frame.scene, "frame.png"),
            "truth": path(&frame.scene, &truth),
            "output": path(&frame.folder, "output.png"),
            "error": path(&frame.folder, "flip.png"),
            "change": (index > 0).then(|| path(&frame.folder, CHANGE_PICTURE)),
            "mse": root(frame.error),
            "flicker": root(frame.flicker),
        })
    };
    let frames: Vec<Value> = sequence.frames.iter().enumerate().map(frame).collect();
    json!({ "name": name(sequence), "frames": frames })
}
