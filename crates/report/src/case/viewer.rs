//! The controls that pictures are looked at with: one set, which the script moves to the case that is open.

use maud::{Markup, html};

use super::legend::legends;
use crate::pixels::layer::Layer;
use suite::BLOCK;
use suite::Run;

/// How pictures are set against each other: the script's word, what a reader calls it, and its key.
const WAYS: [(&str, &str, &str); 4] = [
    ("slide", "Slide", "1"),
    ("blink", "Blink", "2"),
    ("onion", "Onion skin", "3"),
    ("side", "Side by side", "4"),
];

/// What may lie on the left.
const LEFT: [Layer; 3] = [Layer::Truth, Layer::Instant, Layer::Output];

/// Exposures beside the scene's own, in stops.
const EXPOSURES: [(i32, &str); 3] = [(-2, "−2 EV"), (0, "0 EV"), (2, "+2 EV")];

/// What each key does.
const KEYS: [(&str, &str); 11] = [
    ("1 2 3 4", "slide, blink, onion skin, side by side"),
    ("b", "blink: swap the pictures"),
    ("a", "next picture on the left"),
    ("m, M", "next or last picture on the right"),
    ("e", "next exposure"),
    ("[, ]", "move the divider"),
    ("+, -, 0", "zoom in, out, fit"),
    (
        "arrows",
        "on the picture: read the next pixel, with shift the tenth; the view follows. Page up and down zoom",
    ),
    ("j, k", "next or last filter of the scene"),
    ("l, h", "the same filter in the next or last scene"),
    ("o, t", "overview; light or dark"),
];

/// Hidden until a case is open.
pub fn viewer(run: &Run) -> Markup {
    html! {
        div #viewer hidden data-width=(run.width) data-height=(run.height) data-block=(BLOCK) {
            div.controls {
                fieldset.choice {
                    legend { "Compare" }
                    @for (index, (word, title, key)) in WAYS.iter().enumerate() {
                        label title=(format!("Key {key}")) {
                            input type="radio" name="way" value=(word) checked[index == 0];
                            span { (title) }
                        }
                    }
                }
                (choice("Left", "over", &LEFT, Layer::Truth))
                (choice("Right", "under", &Layer::ALL, Layer::Output))
                fieldset.choice {
                    legend { "Exposure" }
                    @for (stops, title) in EXPOSURES {
                        label {
                            input type="radio" name="exposure" value=(stops) checked[stops == 0];
                            span { (title) }
                        }
                    }
                }
                div.choice role="group" aria-label="Zoom" {
                    button type="button" data-zoom="out" aria-label="Zoom out" { "−" }
                    button type="button" data-zoom="fit" { "Fit" }
                    button type="button" data-zoom="in" aria-label="Zoom in" { "+" }
                }
            }
            div.stage style=(format!("--ratio:{}/{}", run.width, run.height)) {
                div.pane.stack tabindex="0" role="group"
                    aria-label="Two pictures; arrows read pixels, plus and minus zoom" {
                    (layer(run, "under"))
                    div.over { (layer(run, "over")) }
                    (marks(run))
                    div.divider aria-hidden="true" {}
                    p.tag.right data-tag="under" {}
                    p.tag.left data-tag="over" {}
                }
                @for place in ["instant", "truth", "output", "map"] {
                    div.pane.single tabindex="0" role="group"
                        aria-label="One picture; arrows read pixels, plus and minus zoom" hidden {
                        (layer(run, place))
                        (marks(run))
                        p.tag.left data-tag=(place) {}
                    }
                }
            }
            label.split {
                span { "Divider" }
                input type="range" name="split" min="0" max="100" step="0.5" value="50";
            }
            p.hint aria-live="polite" {}
            (legends())
            (readout())
            p.spoken.unseen aria-live="polite" {}
            details.keys {
                summary { "Keys" }
                dl {
                    @for (keys, what) in KEYS { div { dt { kbd { (keys) } } dd { (what) } } }
                }
            }
        }
    }
}

fn choice(legend: &str, name: &str, layers: &[Layer], first: Layer) -> Markup {
    html! {
        fieldset.choice {
            legend { (legend) }
            @for layer in layers {
                label {
                    input type="radio" name=(name) value=(layer.name()) data-hint=(layer.hint())
                        data-painter=(layer.painter().name()) checked[*layer == first];
                    span { (layer.title()) }
                }
            }
        }
    }
}

/// A picture that zooms and moves with all others.
fn layer(run: &Run, place: &str) -> Markup {
    html! {
        div.layer data-place=(place) { canvas width=(run.width) height=(run.height) role="img" {} }
    }
}

/// The line of the profile, the worst place of a bound, and the pixel that is read.
fn marks(run: &Run) -> Markup {
    html! {
        div.layer aria-hidden="true" {
            svg.overlay width=(run.width) height=(run.height) viewBox=(format!("0 0 {} {}", run.width, run.height)) {
                path.line fill="none" {}
            }
        }
        div.mark hidden {}
        div.pixel hidden {}
    }
}

/// Lists the numbers of a pixel, one row per picture; the script fills it and hides what a case lacks.
fn readout() -> Markup {
    html! {
        table.readout {
            caption { span { "Point at a picture, or choose it and press an arrow" } " (linear values, three digits)" }
            tbody {
                @for layer in Layer::ALL {
                    tr data-layer=(layer.name()) hidden {
                        th scope="row" { (layer.title()) }
                        @for component in 0..3 {
                            td data-label=[layer.components().split(' ').nth(component).filter(|name| !name.is_empty())] {}
                        }
                    }
                }
            }
        }
    }
}
