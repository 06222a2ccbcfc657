//! The controls that pictures are looked at with: one set, which the script moves to the case that is open.

use maud::{Markup, html};

use super::layer::Layer;
use crate::Run;
use crate::worst::BLOCK;

/// How pictures are set against each other: the script's word, what a reader calls it, and its key.
const WAYS: [(&str, &str, &str); 4] = [
    ("slide", "Slide", "1"),
    ("blink", "Blink", "2"),
    ("onion", "Onion skin", "3"),
    ("side", "Side by side", "4"),
];

/// What may lie on the left.
const LEFT: [Layer; 3] = [Layer::Truth, Layer::Instant, Layer::Output];

/// What each key does.
const KEYS: [(&str, &str); 9] = [
    ("1 2 3 4", "slide, blink, onion skin, side by side"),
    ("b", "blink: swap the pictures"),
    ("a", "next picture on the left"),
    ("m, M", "next or last picture on the right"),
    ("+, -, 0", "zoom in, out, fit"),
    (
        "arrows",
        "on the picture: move it; at fit, the divider. Page up and down zoom",
    ),
    ("j, k", "next or last filter of the scene"),
    ("l, h", "the same filter in the next or last scene"),
    ("o, t", "overview; light or dark"),
];

/// Hidden until a case is open.
pub fn viewer(run: &Run) -> Markup {
    html! {
        div #viewer hidden data-width=(run.width) data-height=(run.height) data-band=(run.guard_band)
            data-block=(BLOCK) {
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
                div.choice role="group" aria-label="Zoom" {
                    button type="button" data-zoom="out" aria-label="Zoom out" { "−" }
                    button type="button" data-zoom="fit" { "Fit" }
                    button type="button" data-zoom="in" aria-label="Zoom in" { "+" }
                }
            }
            div.stage style=(format!("--ratio:{}/{};--band:{}", run.width, run.height, run.guard_band)) {
                div.pane.stack tabindex="0" role="group"
                    aria-label="Two pictures; arrows move, plus and minus zoom" {
                    (layer("under"))
                    div.over { (layer("over")) }
                    div.mark hidden {}
                    div.divider aria-hidden="true" {}
                    p.tag.right data-tag="under" {}
                    p.tag.left data-tag="over" {}
                }
                @for place in ["instant", "truth", "output", "map"] {
                    div.pane.single tabindex="0" role="group"
                        aria-label="One picture; arrows move, plus and minus zoom" hidden {
                        (layer(place))
                        div.mark hidden {}
                        p.tag.left data-tag=(place) {}
                    }
                }
            }
            label.split {
                span { "Divider" }
                input type="range" name="split" min="0" max="100" step="0.5" value="50";
            }
            p.hint aria-live="polite" {}
            p.readout {}
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
                        data-banded[layer.has_band()] checked[*layer == first];
                    span { (layer.title()) }
                }
            }
        }
    }
}

/// A picture that zooms and moves with all others.
fn layer(place: &str) -> Markup {
    html! {
        div.layer data-place=(place) { img alt="" draggable="false"; }
    }
}
