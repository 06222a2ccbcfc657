//! One-line charts next to the same numbers in a table.

use maud::{Markup, html};

use super::ends;

/// Sides of the picture, in its own units.
const WIDTH: f64 = 240.0;
const HEIGHT: f64 = 14.0;
/// Space for a mark at either end.
const MARGIN: f64 = 6.0;
/// Position of a value beyond an end of the scale, in lengths of the scale.
const BEYOND: f64 = 0.01;

/// A scale from left to right. Values beyond it are drawn at its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    /// Value at the left end.
    pub low: f64,
    /// Value at the right end.
    pub high: f64,
}

impl Strip {
    /// Makes a scale with 0 in its middle.
    pub fn about_zero(most: f64) -> Self {
        Self {
            low: -most,
            high: most,
        }
    }

    /// Makes a scale over the range of some values.
    pub fn over(values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = ends(values);
        Self { low, high }
    }

    /// Returns whether a value is off the scale.
    fn is_beyond(&self, value: f64) -> bool {
        let room = BEYOND * (self.high - self.low);
        value < self.low - room || value > self.high + room
    }

    fn place(&self, value: f64) -> f64 {
        let part = if self.high > self.low {
            (value - self.low) / (self.high - self.low)
        } else {
            0.5
        };
        MARGIN + part.clamp(0.0, 1.0) * (WIDTH - 2.0 * MARGIN)
    }

    /// Draws a confidence interval as a line.
    pub fn interval(&self, [low, high]: [f64; 2]) -> Markup {
        let (low, high, middle) = (self.place(low), self.place(high), HEIGHT / 2.0);
        html! { line.interval x1=(short(low)) x2=(short(high)) y1=(middle) y2=(middle) {} }
    }

    /// Draws a value as a disc, or as an arrow towards a value beyond the scale.
    pub fn mark(&self, value: f64, class: &str) -> Markup {
        let (x, y) = (self.place(value), HEIGHT / 2.0);
        let way = if value > self.high { 1.0 } else { -1.0 };
        html! {
            @if self.is_beyond(value) {
                path class=(format!("mark {class}")) d=(format!("M{} {y} l{} -5 v10 z", short(x + 5.0 * way), -9.0 * way)) {}
            } @else {
                circle class=(format!("mark {class}")) cx=(short(x)) cy=(y) r="4" {}
            }
        }
    }

    /// Draws a bar between two values.
    pub fn bar(&self, from: f64, to: f64, class: &str) -> Markup {
        let (from, to) = (self.place(from), self.place(to));
        html! {
            rect class=(format!("bar {class}")) x=(short(from.min(to))) width=(short((to - from).abs())) y="3" height=(HEIGHT - 6.0) {}
        }
    }

    /// Draws a line across the scale.
    pub fn tick(&self, value: f64) -> Markup {
        let x = short(self.place(value));
        html! { line.zero x1=(x) x2=(x) y1="0" y2=(HEIGHT) {} }
    }

    /// Draws the scale below its marks. Screen readers skip it, since the numbers are next to it.
    pub fn draw(&self, marks: &Markup) -> Markup {
        let middle = HEIGHT / 2.0;
        html! {
            svg.drawing.strip viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) aria-hidden="true" focusable="false" {
                line.grid x1=(MARGIN) x2=(WIDTH - MARGIN) y1=(middle) y2=(middle) {}
                (marks)
            }
        }
    }
}

/// Formats a coordinate: a tenth of a unit is thinner than a line.
fn short(coordinate: f64) -> String {
    format!("{coordinate:.1}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_a_scale_lie_at_the_margins() {
        let strip = Strip::over([0.0, 0.3, 0.8].into_iter());
        assert_eq!((strip.low, strip.high), (0.0, 0.8));
        assert_eq!(strip.place(0.0), MARGIN);
        assert_eq!(strip.place(0.4), WIDTH / 2.0);
        assert_eq!(strip.place(0.8), WIDTH - MARGIN);
        assert_eq!(Strip::about_zero(0.0).place(0.0), WIDTH / 2.0);
    }

    #[test]
    fn a_value_beyond_the_scale_is_an_arrow_at_its_end() {
        let strip = Strip::about_zero(1.0);
        assert!(strip.mark(1.0, "").into_string().starts_with("<circle"));
        let beyond = strip.mark(7.0, "").into_string();
        assert!(
            beyond.starts_with("<path") && beyond.contains("M239.0 7 l-9 -5"),
            "{beyond}"
        );
    }
}
