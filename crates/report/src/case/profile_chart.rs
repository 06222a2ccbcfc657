//! Chart of brightness along a line.

use maud::{Markup, html};

use super::profile::{Curve, Profile};
use crate::charts::plot::{Axis, Plot};

/// Draws a profile with its key; screen readers read the values in the middle.
pub fn profile_chart(profile: &Profile) -> Markup {
    let [x, y] = profile.place;
    let points = || profile.curves.iter().flat_map(|curve| &curve.points);
    let across = format!("pixels along the motion, from ({x}, {y})");
    let plot = Plot::wide(
        Axis::linear(&across, points().map(|(distance, _)| *distance)),
        Axis::linear("luminance", points().map(|(_, value)| *value).chain([0.0])),
    );
    let words = words_at_place(profile);
    let label = format!("Brightness along the motion through ({x}, {y}): {words}");
    let marks = html! {
        (plot.line("place", &[(0.0, plot.y.low), (0.0, plot.y.high)]))
        @for curve in profile.curves.iter().rev() { (plot.line(curve.class, &curve.points)) }
    };
    html! {
        figure.profile {
            (plot.draw(&label, &marks))
            figcaption.curves {
                @for curve in &profile.curves {
                    span {
                        svg.drawing viewBox="0 0 28 8" aria-hidden="true" {
                            line class=(format!("line {}", curve.class)) x1="0" x2="28" y1="4" y2="4" {}
                        }
                        (curve.title)
                    }
                }
            }
        }
    }
}

/// `truth 0.31, output 0.52 there`
fn words_at_place(profile: &Profile) -> String {
    let at_place = |curve: &Curve| {
        let mut points = curve.points.iter();
        let middle = points.find(|(distance, _)| *distance == 0.0);
        let (_, value) = middle.expect("a line goes through its place");
        format!("{} {value:.3}", curve.title)
    };
    let words: Vec<String> = profile.curves.iter().map(at_place).collect();
    format!("{} there", words.join(", "))
}
