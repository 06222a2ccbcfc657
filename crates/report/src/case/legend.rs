//! Legend of the pictures' colours.

use colorous::Gradient;
use maud::{Markup, html};

use crate::pixels::layer::{Layer, Painter};

/// Colours of error maps, from none to all.
const MAGMA: Gradient = colorous::MAGMA;
/// Colours of distances, from far to near; for readers who cannot distinguish red from green.
const CIVIDIS: Gradient = colorous::CIVIDIS;
/// Colours of signed errors: purple is too dark, orange too bright, white is right.
const PURPLE_ORANGE: Gradient = colorous::PURPLE_ORANGE;
/// Beside, ahead, behind: three colours that all kinds of colour vision distinguish (Okabe and
/// Ito).
const SIDES: [(&str, &str); 3] = [
    ("e69f00", "beside"),
    ("56b4e9", "ahead"),
    ("cc79a7", "behind"),
];

/// Formats the script's colours: 256 hexadecimal colours per gradient, and the colours of the
/// sides.
pub fn colors() -> String {
    let table = |gradient: Gradient| -> String {
        (0..256)
            .map(|at| format!("{:x}", gradient.eval_rational(at, 256)))
            .collect()
    };
    let sides = SIDES.map(|(color, _)| color);
    let colors = serde_json::json!({
        "magma": table(MAGMA),
        "cividis": table(CIVIDIS),
        "purple_orange": table(PURPLE_ORANGE),
        "sides": sides,
    });
    colors.to_string()
}

/// Explains every way of drawing except radiance; the script shows the key of the picture.
pub fn draw_legends() -> Markup {
    html! {
        @for painter in Painter::ALL {
            @let layers = Layer::ALL.iter().filter(|layer| layer.painter() == *painter);
            @let names: Vec<&str> = layers.map(|layer| layer.name()).collect();
            @if let Some(key) = key(*painter) { p.legend data-legend=(names.join(" ")) hidden { (key) } }
        }
    }
}

fn key(painter: Painter) -> Option<Markup> {
    Some(match painter {
        Painter::Radiance => return None,
        Painter::Share => html! { "0 " (strip(MAGMA, false)) " 1" },
        Painter::Signed => html! {
            "darker " (strip(PURPLE_ORANGE, false)) " brighter; strength is the square root of the difference, and full from black to white"
        },
        Painter::Sides => html! {
            @for (color, side) in SIDES {
                span.swatch style=(format!("background:#{color}")) {} " " (side) "  "
            }
        },
        Painter::Motion => html! {
            canvas.wheel width="48" height="48" aria-hidden="true" {}
            span {
                "right is orange, left is blue, up is light, down is dark, grey does not move; strength is the square root of speed, and full at "
                span.fastest {} " px per frame"
            }
        },
        Painter::Distance => html! {
            "near, " span.nearest {} " m " (strip(CIVIDIS, true)) " far, " span.farthest {} " m; white: no surface"
        },
    })
}

/// Draws a gradient from its first colour to its last, or reversed.
fn strip(gradient: Gradient, reversed: bool) -> Markup {
    const STOPS: usize = 9;
    let colors: Vec<String> = (0..STOPS)
        .map(|at| if reversed { STOPS - 1 - at } else { at })
        .map(|at| format!("#{:x}", gradient.eval_rational(at, STOPS)))
        .collect();
    html! {
        span.strip aria-hidden="true" style=(format!("background:linear-gradient(to right,{})", colors.join(","))) {}
    }
}
