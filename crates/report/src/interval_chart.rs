//! A mean and its interval as a picture of one line.

use maud::{Markup, html};
use metrics::Ideal;

use suite::Overall;

/// Sides of the picture, in its own units.
const WIDTH: f64 = 240.0;
const HEIGHT: f64 = 14.0;
/// Room for a mark at either end.
const MARGIN: f64 = 6.0;

/// What the sides of all pictures of one table stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Left, in the metric's unit.
    pub low: f64,
    /// Right.
    pub high: f64,
}

impl Axis {
    /// Over all of some intervals, and from perfect where that is 0.
    pub fn over(intervals: impl Iterator<Item = [f64; 2]>, ideal: Ideal) -> Self {
        let start = match ideal {
            Ideal::Lowest => [0.0, 0.0],
            Ideal::Target(target) => [target, target],
            Ideal::Highest => [f64::INFINITY, f64::NEG_INFINITY],
        };
        let [low, high] = intervals.fold(start, |[low, high], [a, b]| [low.min(a), high.max(b)]);
        Self { low, high }
    }

    fn place(&self, value: f64) -> f64 {
        let part = match self.high > self.low {
            true => (value - self.low) / (self.high - self.low),
            false => 0.0,
        };
        MARGIN + part.clamp(0.0, 1.0) * (WIDTH - 2.0 * MARGIN)
    }
}

/// The numbers stand beside it as text, so that a reader of the screen need not hear of it.
pub fn interval_chart(axis: &Axis, mean: &Overall, floor: Option<f64>) -> Markup {
    let [low, high] = mean.interval.map(|end| axis.place(end));
    let middle = HEIGHT / 2.0;
    let place = axis.place(mean.mean);
    html! {
        svg viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) aria-hidden="true" focusable="false" {
            line.axis x1=(MARGIN) x2=(WIDTH - MARGIN) y1=(middle) y2=(middle) {}
            @if let Some(floor) = floor {
                rect.floor x=(format!("{:.1}", axis.place(0.0))) y="1" height=(HEIGHT - 2.0)
                    width=(format!("{:.1}", axis.place(floor) - axis.place(0.0))) {}
            }
            line.interval x1=(format!("{low:.1}")) x2=(format!("{high:.1}")) y1=(middle) y2=(middle) {}
            @if mean.is_reference {
                circle.open cx=(format!("{place:.1}")) cy=(middle) r="4" {}
            } @else {
                circle.full cx=(format!("{place:.1}")) cy=(middle) r="4" {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_an_axis_lie_at_the_margins() {
        let axis = Axis::over([[0.2, 0.4], [0.3, 0.8]].into_iter(), Ideal::Lowest);
        assert_eq!((axis.low, axis.high), (0.0, 0.8));
        assert_eq!(axis.place(0.0), MARGIN);
        assert_eq!(axis.place(0.4), WIDTH / 2.0);
        assert_eq!(axis.place(0.8), WIDTH - MARGIN);
        let axis = Axis::over([[20.0, 30.0]].into_iter(), Ideal::Highest);
        assert_eq!((axis.low, axis.high), (20.0, 30.0));
        // An interval of few scenes may reach below perfect.
        let axis = Axis::over([[-0.2, 0.8]].into_iter(), Ideal::Lowest);
        assert!(axis.place(0.0) > MARGIN && axis.place(0.0) < WIDTH / 2.0);
        let point = Axis::over([[0.0, 0.0]].into_iter(), Ideal::Lowest);
        assert_eq!(point.place(0.0), MARGIN);
    }
}
