//! Charts with two axes.

use maud::{Markup, html};

use super::ends;

/// Space for the labels of either axis, and at the other sides.
const LEFT: f64 = 56.0;
const BOTTOM: f64 = 34.0;
const RIGHT: f64 = 10.0;
const TOP: f64 = 10.0;

/// Scale of one axis of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Quantity, with its unit.
    pub title: String,
    /// Value at the left or the bottom.
    pub low: f64,
    /// Value at the other end.
    pub high: f64,
    /// True if equal lengths are equal factors.
    pub log: bool,
    /// Positions with their labels.
    pub ticks: Vec<(f64, String)>,
}

impl Axis {
    /// Makes an axis over the range of some numbers, in equal steps.
    pub fn linear(title: &str, values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = ends(values);
        // A single number is in the middle.
        let room = if high > low {
            0.04 * (high - low)
        } else {
            0.5 * low.abs().max(1e-3)
        };
        let (low, high) = (low - room, high + room);
        Self::new(title, [low, high], false, ticks(low, high))
    }

    /// Makes an axis over the range of some numbers above 0, in equal factors.
    pub fn log(title: &str, values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = ends(values);
        let (low, high) = (low / 1.15, high * 1.15);
        let decades = low.log10().ceil() as i32..=high.log10().floor() as i32;
        let mut ticks: Vec<(f64, String)> = decades
            .map(|power| 10_f64.powi(power))
            .map(|value| (value, value.to_string()))
            .collect();
        if ticks.len() < 2 {
            ticks = [low * 1.15, high / 1.15]
                .map(|value| (value, short(value)))
                .into();
        }
        Self::new(title, [low, high], true, ticks)
    }

    /// Makes an axis with one position per word.
    pub fn words(title: &str, words: &[String]) -> Self {
        let ends = [-0.5, words.len() as f64 - 0.5];
        let places = (0..).map(f64::from);
        Self::new(title, ends, false, places.zip(words.to_vec()).collect())
    }

    fn new(title: &str, [low, high]: [f64; 2], log: bool, ticks: Vec<(f64, String)>) -> Self {
        Self {
            title: title.to_owned(),
            low,
            high,
            log,
            ticks,
        }
    }

    /// Scales a value: 0 at one end, 1 at the other.
    fn part(&self, value: f64) -> f64 {
        if self.log {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }
}

/// Two axes, and marks positioned by them.
#[derive(Clone, Debug)]
pub struct Plot {
    /// Width and height, in the picture's own units.
    pub size: [f64; 2],
    /// To the right.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
}

impl Plot {
    /// Makes a chart with others next to it.
    pub fn small(x: Axis, y: Axis) -> Self {
        let size = [360.0, 220.0];
        Self { size, x, y }
    }

    /// Makes a chart as wide as a text.
    pub fn wide(x: Axis, y: Axis) -> Self {
        let size = [640.0, 280.0];
        Self { size, x, y }
    }

    /// Finds the position of a pair of values in the chart.
    pub fn place(&self, x: f64, y: f64) -> (f64, f64) {
        let [width, height] = self.size;
        (
            LEFT + self.x.part(x) * (width - LEFT - RIGHT),
            height - BOTTOM - self.y.part(y) * (height - TOP - BOTTOM),
        )
    }

    /// Draws a disc that shows words under the pointer.
    pub fn mark(&self, (x, y): (f64, f64), class: &str, radius: f64, words: &str) -> Markup {
        let (x, y) = self.place(x, y);
        html! {
            circle class=(format!("mark {class}")) cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r=(radius) { title { (words) } }
        }
    }

    /// Draws a line through pairs of values.
    pub fn line(&self, class: &str, points: &[(f64, f64)]) -> Markup {
        let places: Vec<String> = (points.iter())
            .map(|(x, y)| self.place(*x, *y))
            .map(|(x, y)| format!("{x:.1},{y:.1}"))
            .collect();
        html! { polyline class=(format!("line {class}")) points=(places.join(" ")) {} }
    }

    /// Draws a line from one side to the other.
    pub fn level(&self, class: &str, y: f64) -> Markup {
        self.line(class, &[(self.x.low, y), (self.x.high, y)])
    }

    /// Draws the axes below the marks; `label` describes the chart to screen readers.
    pub fn draw(&self, label: &str, marks: &Markup) -> Markup {
        let [width, height] = self.size;
        let (right, bottom) = (width - RIGHT, height - BOTTOM);
        html! {
            svg.drawing viewBox=(format!("0 0 {width} {height}")) role="img" aria-label=(label) {
                @for (value, words) in &self.x.ticks {
                    @let (x, _) = self.place(*value, self.y.low);
                    line.grid x1=(format!("{x:.1}")) x2=(format!("{x:.1}")) y1=(TOP) y2=(bottom) {}
                    text x=(format!("{x:.1}")) y=(bottom + 13.0) text-anchor="middle" { (words) }
                }
                @for (value, words) in &self.y.ticks {
                    @let (_, y) = self.place(self.x.low, *value);
                    line.grid x1=(LEFT) x2=(right) y1=(format!("{y:.1}")) y2=(format!("{y:.1}")) {}
                    text x=(LEFT - 4.0) y=(format!("{:.1}", y + 4.0)) text-anchor="end" { (words) }
                }
                text x=(f64::midpoint(LEFT, right)) y=(height - 5.0) text-anchor="middle" { (self.x.title) }
                text transform=(format!("translate(10 {}) rotate(-90)", f64::midpoint(TOP, bottom))) text-anchor="middle" { (self.y.title) }
                (marks)
            }
        }
    }
}

/// Lists three to six round numbers between two.
fn ticks(low: f64, high: f64) -> Vec<(f64, String)> {
    let rough = (high - low) / 5.0;
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .map(|factor| factor * power)
        .into_iter()
        .find(|step| *step >= rough)
        .unwrap_or(power);
    let digits = (-step.log10().floor()).max(0.0) as usize;
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    (first..=last)
        .map(|count| count as f64 * step)
        .map(|value| (value, format!("{value:.digits$}")))
        .collect()
}

/// Formats a number with two digits.
fn short(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if !(1e-3..1e5).contains(&size) => format!("{value:.0e}"),
        size => format!("{value:.*}", (1.0 - size.log10().floor()).max(0.0) as usize),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_few() {
        let words = |low, high| {
            ticks(low, high)
                .into_iter()
                .map(|(_, word)| word)
                .collect::<Vec<_>>()
        };
        assert_eq!(words(0.0, 1.0), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(words(-21.0, 4.0), ["-20", "-15", "-10", "-5", "0"]);
        assert_eq!(words(0.93, 1.32), ["1.0", "1.1", "1.2", "1.3"]);
    }

    #[test]
    fn a_plot_puts_low_values_left_and_below() {
        let plot = Plot::small(
            Axis::log("x", [0.01, 10.0].into_iter()),
            Axis::linear("y", [-1.0, 3.0].into_iter()),
        );
        let ((left, below), (right, above)) = (plot.place(0.01, -1.0), plot.place(10.0, 3.0));
        assert!(left < right && below > above);
        assert!(
            left > LEFT && right < plot.size[0] - RIGHT,
            "{left} {right}"
        );
        // The middle of three decades is half way.
        let (middle, _) = plot.place(0.1_f64.sqrt(), 0.0);
        assert!((middle - f64::midpoint(left, right)).abs() < 1e-9);
    }

    #[test]
    fn a_single_value_has_an_axis_all_the_same() {
        let axis = Axis::linear("x", [0.0].into_iter());
        assert!(axis.low < 0.0 && axis.high > 0.0);
        let axis = Axis::log("x", [3.0].into_iter());
        assert!(axis.part(3.0).is_finite());
    }
}
