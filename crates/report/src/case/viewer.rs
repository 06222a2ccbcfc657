//! Viewer of pictures: one set of controls, which the script moves to the open case.

use judge::BLOCK;
use maud::{Markup, html};
use measure::Run;
use serde_json::{Value, json};

use super::legend::draw_legends;
use crate::document::script_data;
use crate::pixels::layer::Layer;

/// Modes of comparing two pictures: the script's word, the name, and the key.
const MODES: [(&str, &str, &str); 5] = [
    ("slide", "Slide", "1"),
    ("blink", "Blink", "2"),
    ("onion", "Onion skin", "3"),
    ("side", "Side by side", "4"),
    ("difference", "Difference", "5"),
];

/// Exposures relative to the scene's own, in stops.
const EXPOSURES: [(i32, &str); 3] = [(-2, "−2 EV"), (0, "0 EV"), (2, "+2 EV")];

/// Keys and their actions.
const KEYS: [(&str, &str); 14] = [
    (
        "1 to 5",
        "slide, blink, onion skin, side by side, difference",
    ),
    ("b", "blink; stop; then change the picture"),
    ("a, A", "next or previous picture on the left"),
    ("m, M", "next or previous picture on the right"),
    ("x", "exchange left and right"),
    ("w", "zoom to the worst place"),
    ("+, -, 0, wheel", "zoom in, out, fit"),
    ("e", "next exposure"),
    ("[, ]", "move the divider"),
    (
        "arrows",
        "on the picture: read the next pixel, with shift the tenth; page up and down zoom",
    ),
    ("j, k", "next or previous filter of the scene"),
    ("l, h", "the same filter in the next or previous scene"),
    ("o, t", "overview; light or dark"),
    ("?", "these keys"),
];

/// Writes the viewer, hidden until a case is open.
pub fn viewer(run: &Run) -> Markup {
    html! {
        div #viewer hidden data-width=(run.render.width) data-height=(run.render.height) data-block=(BLOCK) {
            (controls())
            (stage(run))
            p.hint aria-live="polite" {}
            (draw_legends())
            details.more {
                summary { "Exposure, divider and the numbers of a pixel" }
                fieldset.choice {
                    legend { "Exposure" }
                    @for (stops, title) in EXPOSURES {
                        label {
                            input type="radio" name="exposure" value=(stops) checked[stops == 0];
                            span { (title) }
                        }
                    }
                }
                label.split {
                    span { "Divider" }
                    input type="range" name="split" min="0" max="100" step="0.5" value="50";
                }
                (readout())
            }
            p.spoken.unseen aria-live="polite" {}
            p.tip hidden aria-hidden="true" {}
            (script_data("layers", &layers()))
        }
        dialog #keys aria-label="Keys" {
            form method="dialog" { button { "Close" } }
            dl { @for (keys, action) in KEYS { div { dt { kbd { (keys) } } dd { (action) } } } }
        }
    }
}

/// Writes the controls above the pictures.
fn controls() -> Markup {
    html! {
        div.controls {
            div.toolbar {
                label.menu { "Left " select name="left" {} }
                button type="button" data-do="exchange" aria-label="Exchange left and right" title="Key x" { "⇄" }
                label.menu { "Right " select name="right" {} }
                fieldset.choice {
                    legend.unseen { "Compare" }
                    @for (index, (word, title, key)) in MODES.iter().enumerate() {
                        label title=(format!("Key {key}")) {
                            input type="radio" name="mode" value=(word) checked[index == 0];
                            span { (title) }
                        }
                    }
                }
                div.choice role="group" aria-label="Zoom" {
                    button type="button" data-do="out" aria-label="Zoom out" { "−" }
                    output.zoom aria-label="Zoom" { "1×" }
                    button type="button" data-do="in" aria-label="Zoom in" { "+" }
                    button type="button" data-do="fit" { "Fit" }
                    button type="button" data-do="worst" title="Key w" { "Worst place" }
                }
                button.help type="button" aria-label="Keys" { "?" }
            }
        }
    }
}

/// Writes the panes: two pictures under a divider, or next to each other.
fn stage(run: &Run) -> Markup {
    html! {
        div.stage style=(format!("--ratio:{}/{}", run.render.width, run.render.height)) {
            div.pane.stack tabindex="0" role="group"
                aria-label="Two pictures; arrows read pixels, plus and minus zoom" {
                (layer(run, "under"))
                div.over { (layer(run, "over")) }
                (marks(run))
                div.divider aria-hidden="true" {}
                p.tag.right data-tag="under" {}
                p.tag.left data-tag="over" {}
            }
            @for place in ["left", "right"] {
                div.pane.single tabindex="0" role="group"
                    aria-label="One picture; arrows read pixels, plus and minus zoom" hidden {
                    (layer(run, place))
                    (marks(run))
                    p.tag.left data-tag=(place) {}
                }
            }
        }
    }
}

/// Describes every kind of picture for the script, as JSON.
fn layers() -> String {
    let describe = |layer: &Layer| {
        let facts = json!({
            "title": layer.title(),
            "hint": layer.help(),
            "painter": layer.painter(),
        });
        (layer.name().to_owned(), facts)
    };
    Value::Object(Layer::ALL.iter().map(describe).collect()).to_string()
}

/// Makes a picture that zooms and pans with all others.
fn layer(run: &Run, place: &str) -> Markup {
    html! {
        div.layer data-place=(place) { canvas width=(run.render.width) height=(run.render.height) role="img" {} }
    }
}

/// Marks the profile's line, a bound's worst place, and the pixel that is read.
fn marks(run: &Run) -> Markup {
    let [width, height] = [run.render.width, run.render.height];
    html! {
        div.layer aria-hidden="true" {
            svg.overlay width=(width) height=(height) viewBox=(format!("0 0 {width} {height}")) {
                path.line.shade fill="none" {}
                path.line fill="none" {}
            }
        }
        div.mark hidden {}
        div.pixel hidden {}
    }
}

/// Lists the numbers of a pixel, one row per picture; the script fills it and hides rows that a
/// case lacks.
fn readout() -> Markup {
    html! {
        table.readout {
            caption { span { "Point at a picture, or choose it and press an arrow" } " (linear values, three digits)" }
            tbody {
                @for layer in Layer::ALL {
                    tr data-layer=(layer.name()) hidden {
                        th scope="row" { (layer.title()) }
                        @for component in 0..3 {
                            td data-label=[layer.components().get(component)] {}
                        }
                    }
                }
            }
        }
    }
}
