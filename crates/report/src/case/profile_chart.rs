//! Chart of brightness along a line.

use maud::{Markup, html};

use super::profile::{Curve, Profile};
use crate::charts::plot::{Axis, Plot};

/// Draws a profile with its key; a screen reader hears the values in the middle.
pub fn profile_chart(profile: &Profile) -> Markup {
    let [x, y] = profile.place;
    let values = profile.curves.iter().flat_map(|curve| &curve.values);
    let values = values.map(|value| f64::from(*value));
    let distances = profile
        .distances
        .iter()
        .map(|distance| f64::from(*distance));
    let across = format!("pixels along the motion, from ({x}, {y})");
    let plot = Plot::wide(
        Axis::linear(&across, distances),
        Axis::linear("luminance", values.chain([0.0])),
    );
    let words = words_at_place(profile);
    let label = format!("Brightness along the motion through ({x}, {y}): {words}");
    let marks = html! {
        (plot.line("place", &[(0.0, plot.y.low), (0.0, plot.y.high)]))
        @for curve in profile.curves.iter().rev() { (plot.line(curve.class, &points(profile, curve))) }
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

fn points(profile: &Profile, curve: &Curve) -> Vec<(f64, f64)> {
    let points = profile.distances.iter().zip(&curve.values);
    points
        .map(|(distance, value)| (f64::from(*distance), f64::from(*value)))
        .collect()
}

/// `truth 0.31, output 0.52 there`
fn words_at_place(profile: &Profile) -> String {
    let mut distances = profile.distances.iter();
    let middle = distances.position(|distance| *distance == 0.0);
    let middle = middle.expect("a line goes through its place");
    let words: Vec<String> = (profile.curves.iter())
        .map(|curve| format!("{} {:.3}", curve.title, curve.values[middle]))
        .collect();
    format!("{} there", words.join(", "))
}
