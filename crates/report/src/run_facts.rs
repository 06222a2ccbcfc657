//! Settings that a run's scores depend on.

use std::collections::HashSet;

use filters::AdapterDescription;
use frame::Alignment;
use maud::{Markup, html};
use measure::{Case, Run};
use scene::SceneId;

use crate::case_table::CaseTable;
use crate::table::Column::{Plain, Text};
use crate::table::scroll_table;

/// Lists command, program, adapter, settings, and the hashes of each scene's truths.
pub fn provenance(table: &CaseTable) -> Markup {
    let caption = "Truths; a hash covers scene, meshes, textures, settings and the tracer, or all that an engine drew";
    html! {
        section.provenance {
            h2 { "Provenance" }
            dl {
                @for (term, text) in facts(table.run) {
                    div { dt { (term) } dd { (text) } }
                }
            }
            (scroll_table(Some("stacked"), "Truths", Some(caption), &[
                Plain("scene"), Text("family"), Plain("exposure, frames"), Text("shutter"), Text("made by"),
                Text("hash of the truth"),
            ], &truths(table)))
        }
    }
}

/// Lists term and text of all that a run's scores depend on.
pub fn facts(run: &Run) -> Vec<(&'static str, String)> {
    let adapter = match &run.adapter {
        Some(adapter) => adapter_text(adapter),
        None => "none: every filter is a program".to_owned(),
    };
    let render = &run.render;
    let rendered = if run.cases.iter().any(|case| case.drawn.is_some()) {
        "; not where an engine drew them"
    } else {
        ""
    };
    let sky = if render.options.sky_velocity {
        "with a velocity"
    } else {
        "without velocity"
    };
    let pictures = format!("{} pixels", render.size());
    let truth = format!(
        "{} samples per pixel in {} replicates, seed {}{rendered}",
        render.samples_per_pixel, render.replicates, render.seed
    );
    let frame = format!(
        "velocity {}, colour {}, background {sky}, guard band of {} pixels{rendered}",
        render.options.velocity, render.options.color, render.guard_band
    );
    vec![
        ("command", command(run)),
        ("program", run.program.clone()),
        ("adapter", adapter),
        ("pictures", pictures),
        ("truth", truth),
        ("frame", frame),
        ("shutter in common", run.common_alignment.to_string()),
    ]
}

/// Formats the same in one line, for every case.
pub fn provenance_line(run: &Run) -> String {
    let adapter = match &run.adapter {
        Some(adapter) => format!("{}, driver {}", adapter.name, adapter.driver),
        None => "no adapter".to_owned(),
    };
    format!(
        "{}, {adapter}; {}x{}, {} samples per pixel, seed {}; made by: {}",
        run.program,
        run.render.width,
        run.render.height,
        run.render.samples_per_pixel,
        run.render.seed,
        shorten(command(run))
    )
}

/// Most letters of a command line that every case repeats; a merge may name thousands of parts.
const LONGEST_COMMAND: usize = 500;

/// Shortens a command line that is too long to repeat.
fn shorten(command: String) -> String {
    match command.char_indices().nth(LONGEST_COMMAND) {
        None => command,
        Some((end, _)) => format!("{} ... (run.json has all of it)", &command[..end]),
    }
}

/// Formats name, kind, backend and driver of an adapter.
pub fn adapter_text(adapter: &AdapterDescription) -> String {
    let AdapterDescription {
        name,
        kind,
        backend,
        driver,
    } = adapter;
    format!("{name} ({kind}, {backend}, driver {driver})")
}

/// Formats the words of the command line, with the program's name instead of its path.
pub fn command(run: &Run) -> String {
    let words = run.command.iter().skip(1).map(String::as_str);
    let words: Vec<&str> = std::iter::once("shuttertruth").chain(words).collect();
    words.join(" ")
}

/// Describes a truth: `path traced`, or `mean of 32 sub-frames that three.js 0.187.0 drew`.
pub fn truth_text(case: &Case) -> String {
    (case.drawn.as_ref()).map_or("path traced".to_owned(), |drawn| drawn.truth_text())
}

/// Writes a row per scene and shutter.
fn truths(table: &CaseTable) -> Markup {
    let mut shown: HashSet<(&SceneId, Alignment)> = HashSet::new();
    let cases = table.scenes.iter().flat_map(|scene| table.cases_on(scene));
    html! {
        @for (_, case) in cases.filter(|(_, case)| shown.insert((&case.scene, case.alignment))) {
            tr {
                th scope="row" { (case.scene) }
                td.text { (case.family.map_or("", |family| family.name())) }
                td data-label="exposure, frames" { (case.exposure) }
                td.text { (case.alignment) }
                td.text { (truth_text(case)) }
                td.text { code { (case.truth_hash) } }
            }
        }
    }
}

#[test]
fn a_command_line_of_thousands_of_parts_is_cut() {
    let [whole, long] = [LONGEST_COMMAND, LONGEST_COMMAND + 1].map(|count| "ü".repeat(count));
    assert_eq!(shorten(whole.clone()), whole);
    let cut = format!("{whole} ... (run.json has all of it)");
    assert_eq!(shorten(long), cut);
}
