//! Viewer of pictures: one set of controls, which the script moves to the open case.

use frame::Size;
use judge::BLOCK;
use maud::{Markup, html};
use serde_json::{Value, json};

use super::legend::draw_legends;
use crate::document::script_data;
use crate::pixels::layer::Layer;

/// Scripts of the viewer, in the order in which they run.
pub const VIEWER_SCRIPTS: [&str; 6] = [
    include_str!("../assets/planes.js"),
    include_str!("../assets/paint.js"),
    include_str!("../assets/pictures.js"),
    include_str!("../assets/viewer.js"),
    include_str!("../assets/readout.js"),
    include_str!("../assets/keys.js"),
];

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

/// Title and hint of each kind of picture.
pub type LayerWords<'a> = &'a dyn Fn(Layer) -> (String, String);

/// Words for the cases of a run.
pub fn case_words(layer: Layer) -> (String, String) {
    (layer.title().to_owned(), layer.help().to_owned())
}

/// Writes the viewer, hidden until a case is open.
pub fn viewer(size: Size, words: LayerWords) -> Markup {
    html! {
        div #viewer hidden data-width=(size.width) data-height=(size.height) data-block=(BLOCK) {
            (controls())
            (stage(size))
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
                (readout(words))
            }
            p.spoken.unseen aria-live="polite" {}
            p.tip hidden aria-hidden="true" {}
            (script_data("layers", &layers(words)))
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
fn stage(size: Size) -> Markup {
    html! {
        div.stage style=(format!("--ratio:{}/{}", size.width, size.height)) {
            div.pane.stack tabindex="0" role="group"
                aria-label="Two pictures; arrows read pixels, plus and minus zoom" {
                (layer(size, "under"))
                div.over { (layer(size, "over")) }
                (marks(size))
                div.divider aria-hidden="true" {}
                p.tag.right data-tag="under" {}
                p.tag.left data-tag="over" {}
            }
            @for place in ["left", "right"] {
                div.pane.single tabindex="0" role="group"
                    aria-label="One picture; arrows read pixels, plus and minus zoom" hidden {
                    (layer(size, place))
                    (marks(size))
                    p.tag.left data-tag=(place) {}
                }
            }
        }
    }
}

/// Describes every kind of picture for the script, as JSON.
fn layers(words: LayerWords) -> String {
    let describe = |layer: &Layer| {
        let (title, hint) = words(*layer);
        let facts = json!({
            "title": title,
            "hint": hint,
            "painter": layer.painter(),
        });
        (layer.name().to_owned(), facts)
    };
    Value::Object(Layer::ALL.iter().map(describe).collect()).to_string()
}

/// Makes a picture that zooms and pans with all others.
fn layer(size: Size, place: &str) -> Markup {
    html! {
        div.layer data-place=(place) { canvas width=(size.width) height=(size.height) role="img" {} }
    }
}

/// Marks the profile's line, a bound's worst place, and the pixel that is read.
fn marks(Size { width, height }: Size) -> Markup {
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
fn readout(words: LayerWords) -> Markup {
    html! {
        table.readout {
            caption { span { "Point at a picture, or choose it and press an arrow" } " (linear values, three digits)" }
            tbody {
                @for layer in Layer::ALL {
                    tr data-layer=(layer.name()) hidden {
                        th scope="row" { (words(*layer).0) }
                        @for component in 0..3 {
                            td data-label=[layer.components().get(component)] {}
                        }
                    }
                }
            }
        }
    }
}
