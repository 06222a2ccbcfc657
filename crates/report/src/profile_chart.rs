//! A line profile as a picture.

use maud::{Markup, html};

use super::profile::{Curve, Profile};

/// Sides of the picture, in its own units.
const WIDTH: f32 = 640.0;
const HEIGHT: f32 = 220.0;
/// Room for the numbers at the left and below.
const LEFT: f32 = 44.0;
const BELOW: f32 = 34.0;
const MARGIN: f32 = 8.0;

/// With its key, and in words what a reader of the screen cannot see.
pub fn profile_chart(profile: &Profile) -> Markup {
    let [x, y] = profile.place;
    let top = profile.curves.iter().flat_map(|curve| &curve.values);
    let top = top.copied().fold(f32::MIN_POSITIVE, f32::max);
    let first = profile.distances.first().copied().unwrap_or(0.0);
    let last = profile.distances.last().copied().unwrap_or(0.0);
    let across = |distance: f32| {
        let part = (distance - first) / (last - first).max(1.0);
        LEFT + part * (WIDTH - LEFT - MARGIN)
    };
    let up = |value: f32| HEIGHT - BELOW - (value / top).max(0.0) * (HEIGHT - BELOW - MARGIN);
    let bottom = up(0.0);
    html! {
        figure.profile {
            svg viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) role="img"
                aria-label=(format!("Brightness along the motion through ({x}, {y}): {}", in_words(profile))) {
                line.axis x1=(LEFT) x2=(WIDTH - MARGIN) y1=(bottom) y2=(bottom) {}
                line.axis x1=(LEFT) x2=(LEFT) y1=(MARGIN) y2=(bottom) {}
                line.place x1=(short(across(0.0))) x2=(short(across(0.0))) y1=(MARGIN) y2=(bottom) {}
                text x=(LEFT - 6.0) y=(bottom) text-anchor="end" { "0" }
                text x=(LEFT - 6.0) y=(MARGIN + 10.0) text-anchor="end" { (format!("{top:.2}")) }
                text x=(LEFT) y=(bottom + 14.0) text-anchor="middle" { (first) }
                text x=(short(across(0.0))) y=(bottom + 14.0) text-anchor="middle" { "0" }
                text x=(WIDTH - MARGIN) y=(bottom + 14.0) text-anchor="end" { (last) }
                text x=((LEFT + WIDTH) / 2.0) y=(HEIGHT - 4.0) text-anchor="middle" {
                    "pixels along the motion, from (" (x) ", " (y) ")"
                }
                @for curve in profile.curves.iter().rev() {
                    polyline class=(curve.class) points=(points(profile, curve, across, up)) {}
                }
            }
            figcaption.curves {
                @for curve in &profile.curves {
                    span {
                        svg viewBox="0 0 28 8" aria-hidden="true" {
                            line class=(curve.class) x1="0" x2="28" y1="4" y2="4" {}
                        }
                        (curve.title)
                    }
                }
            }
        }
    }
}

fn points(
    profile: &Profile,
    curve: &Curve,
    across: impl Fn(f32) -> f32,
    up: impl Fn(f32) -> f32,
) -> String {
    let points = profile.distances.iter().zip(&curve.values);
    let points: Vec<String> = points
        .map(|(distance, value)| format!("{},{}", short(across(*distance)), short(up(*value))))
        .collect();
    points.join(" ")
}

/// `truth 0.31, output 0.52 at the place`
fn in_words(profile: &Profile) -> String {
    let middle = profile
        .distances
        .iter()
        .position(|distance| *distance == 0.0);
    let middle = middle.expect("a line goes through its place");
    let words: Vec<String> = (profile.curves.iter())
        .map(|curve| format!("{} {:.3}", curve.title, curve.values[middle]))
        .collect();
    format!("{} there", words.join(", "))
}

/// A tenth of a unit is less than a line is wide.
fn short(coordinate: f32) -> String {
    format!("{coordinate:.1}")
}
