//! A change and its interval as a picture of one line, with no change in its middle.

use maud::{Markup, html};

/// Sides of the picture, in its own units.
const WIDTH: f64 = 240.0;
const HEIGHT: f64 = 14.0;
/// Room for a mark at either end.
const MARGIN: f64 = 6.0;

/// `most` is what either end of the line stands for. The numbers stand beside it as text.
pub fn chart(worse: f64, interval: [f64; 2], most: f64) -> Markup {
    let place = |value: f64| match most > 0.0 {
        true => WIDTH / 2.0 + (value / most).clamp(-1.0, 1.0) * (WIDTH / 2.0 - MARGIN),
        false => WIDTH / 2.0,
    };
    let [low, high] = interval.map(place);
    let middle = HEIGHT / 2.0;
    let class = match worse > 0.0 {
        true => "mark worse",
        false => "mark",
    };
    html! {
        svg.drawing viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) aria-hidden="true" focusable="false" {
            line.grid x1=(MARGIN) x2=(WIDTH - MARGIN) y1=(middle) y2=(middle) {}
            line.zero x1=(WIDTH / 2.0) x2=(WIDTH / 2.0) y1="0" y2=(HEIGHT) {}
            line.interval x1=(format!("{low:.1}")) x2=(format!("{high:.1}")) y1=(middle) y2=(middle) {}
            circle class=(class) cx=(format!("{:.1}", place(worse))) cy=(middle) r="4" {}
        }
    }
}
