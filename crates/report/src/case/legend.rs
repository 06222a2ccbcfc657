//! Legend of the pictures' colours.

use colorous::Gradient;
use maud::{Markup, html};

use crate::pixels::layer::{Layer, Painter};

/// Colours of error maps, from none to all.
const MAGMA: Gradient = colorous::MAGMA;
/// Colours of distances, from far to near; made for readers who do not tell red from green.
const CIVIDIS: Gradient = colorous::CIVIDIS;
/// Colours of signed errors: purple is too dark, orange too bright, white is right.
const PURPLE_ORANGE: Gradient = colorous::PURPLE_ORANGE;
/// Beside, ahead, behind: three colours that every kind of colour vision tells apart (Okabe and Ito).
const SIDES: [(&str, &str); 3] = [
    ("e69f00", "beside"),
    ("56b4e9", "ahead"),
    ("cc79a7", "behind"),
];

/// Writes the colours that the script paints with: per gradient 256 colours in hexadecimal digits, and the colours of the sides.
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

/// Explains every way of drawing; the script shows the key of the picture.
pub fn draw_legends() -> Markup {
    html! {
        (legend(Painter::Share, html! {
            "0 " (strip(MAGMA, false)) " 1"
        }))
        (legend(Painter::Signed, html! {
            "darker " (strip(PURPLE_ORANGE, false)) " brighter; strength is the square root of the difference, and full from black to white"
        }))
        (legend(Painter::Sides, html! {
            @for (color, side) in SIDES {
                span.swatch style=(format!("background:#{color}")) {} " " (side) "  "
            }
        }))
        (legend(Painter::Motion, html! {
            canvas.wheel width="48" height="48" aria-hidden="true" {}
            span {
                "right is orange, left is blue, up is light, down is dark, grey stands still; strength is the square root of speed, and full at "
                span.fastest {} " px per frame"
            }
        }))
        (legend(Painter::Distance, html! {
            "near, " span.nearest {} " m " (strip(CIVIDIS, true)) " far, " span.farthest {} " m; white: no surface"
        }))
    }
}

fn legend(painter: Painter, content: Markup) -> Markup {
    let layers = Layer::ALL
        .into_iter()
        .filter(|layer| layer.painter() == painter);
    let names: Vec<&str> = layers.map(Layer::name).collect();
    html! { p.legend data-legend=(names.join(" ")) hidden { (content) } }
}

/// Draws a gradient from its first colour to its last, or the other way round.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_way_of_drawing_but_radiance_has_a_key() {
        let legends = draw_legends().into_string();
        for layer in Layer::ALL {
            let named = (legends.split("data-legend=\"").skip(1))
                .filter_map(|rest| rest.split('"').next())
                .any(|names| names.split(' ').any(|name| name == layer.name()));
            assert_eq!(named, layer.painter() != Painter::Radiance, "{layer:?}");
        }
    }
}
