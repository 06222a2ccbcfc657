//! Error against time as a picture, and which filters nothing beats in both.

use maud::{Markup, html};

/// Sides of the picture, in its own units.
const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 300.0;
/// Room for the numbers at the left and below.
const LEFT: f64 = 52.0;
const BELOW: f64 = 36.0;
const MARGIN: f64 = 12.0;
/// Lines nearer than this part of the height have no room for a name each.
const NEAR: f64 = 0.05;

/// A filter that was timed.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// What a reader calls it.
    pub title: String,
    /// Time of all its passes.
    pub milliseconds: f64,
    /// Mean FLIP where anything moves, against one shutter for all.
    pub error: f64,
}

/// Whether no other point is as fast and as good, and better in one of both.
pub fn is_best(point: &Point, all: &[Point]) -> bool {
    let beats = |other: &Point| {
        other.milliseconds <= point.milliseconds
            && other.error <= point.error
            && (other.milliseconds, other.error) != (point.milliseconds, point.error)
    };
    !all.iter().any(beats)
}

/// Filters as numbered marks, full where nothing beats them, and bars as lines; below it the same as a table.
pub fn pareto_chart(points: &[Point], bars: &[(String, f64)]) -> Markup {
    if points.is_empty() {
        return html! {
            p { "None of the run's filters was timed with the parameters that it ran with." }
        };
    }
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.milliseconds.total_cmp(&b.milliseconds));
    let (fastest, slowest) = (
        sorted[0].milliseconds,
        sorted[sorted.len() - 1].milliseconds,
    );
    let errors = sorted
        .iter()
        .map(|point| point.error)
        .chain(bars.iter().map(|bar| bar.1));
    let top = 1.05 * errors.fold(f64::MIN_POSITIVE, f64::max);
    let across = |milliseconds: f64| {
        let span = (slowest / fastest).ln().max(1e-3);
        LEFT + 16.0 + (milliseconds / fastest).ln() / span * (WIDTH - LEFT - MARGIN - 32.0)
    };
    let up = |error: f64| HEIGHT - BELOW - error / top * (HEIGHT - BELOW - MARGIN);
    let bottom = up(0.0);
    html! {
        figure.pareto {
            svg viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) role="img"
                aria-label="Mean FLIP* against time; the table below has the numbers" {
                line.axis x1=(LEFT) x2=(WIDTH - MARGIN) y1=(bottom) y2=(bottom) {}
                line.axis x1=(LEFT) x2=(LEFT) y1=(MARGIN) y2=(bottom) {}
                text x=(LEFT - 6.0) y=(bottom) text-anchor="end" { "0" }
                text x=(LEFT - 6.0) y=(MARGIN + 10.0) text-anchor="end" { (format!("{top:.2}")) }
                text x=(place(across(fastest))) y=(bottom + 14.0) text-anchor="middle" { (format!("{fastest:.2}")) }
                @if slowest > fastest {
                    text x=(place(across(slowest))) y=(bottom + 14.0) text-anchor="middle" { (format!("{slowest:.2}")) }
                }
                text x=((LEFT + WIDTH) / 2.0) y=(HEIGHT - 4.0) text-anchor="middle" { "ms, logarithmic; upwards: mean FLIP*, low is good" }
                @for (title, error) in labelled(bars, top) {
                    line.bar x1=(LEFT) x2=(WIDTH - MARGIN) y1=(place(up(error))) y2=(place(up(error))) {}
                    text.bar x=(WIDTH - MARGIN) y=(place(up(error) - 3.0)) text-anchor="end" { (title) }
                }
                @for (index, point) in sorted.iter().enumerate() {
                    circle.full[is_best(point, points)].open[!is_best(point, points)] r="5"
                        cx=(place(across(point.milliseconds))) cy=(place(up(point.error))) { title { (point.title) } }
                    text x=(place(across(point.milliseconds))) y=(place(up(point.error) - 8.0)) text-anchor="middle" { (index + 1) }
                }
            }
            figcaption { "FLIP* is FLIP against one shutter for all. Full marks: no other filter is both as fast and as good. Dashed lines: bars, which no time belongs to." }
        }
        div.scroll tabindex="0" role="region" aria-label="Quality against time" {
            table {
                thead {
                    tr {
                        th scope="col" { "filter" }
                        th scope="col" { "mark" }
                        th scope="col" { "ms" }
                        th scope="col" { "mean FLIP*" }
                        th scope="col" { "nothing beats it" }
                    }
                }
                tbody {
                    @for (index, point) in sorted.iter().enumerate() {
                        tr {
                            th scope="row" { (point.title) }
                            td { (index + 1) }
                            td { (format!("{:.2}", point.milliseconds)) }
                            td { (format!("{:.4}", point.error)) }
                            td { @if is_best(point, points) { "✓" } }
                        }
                    }
                    @for (title, error) in bars {
                        tr.bar {
                            th scope="row" { (title) }
                            td { "-" }
                            td { "-" }
                            td { (format!("{error:.4}")) }
                            td {}
                        }
                    }
                }
            }
        }
    }
}

/// The bars, lowest first; of those whose lines lie too near for a name each, the uppermost names all.
fn labelled(bars: &[(String, f64)], top: f64) -> Vec<(String, f64)> {
    let mut sorted = bars.to_vec();
    sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
    let near = |a: &(String, f64), b: &(String, f64)| b.1 - a.1 < NEAR * top;
    let groups = sorted.chunk_by(near).flat_map(|group| {
        let last = group.len() - 1;
        let title = match group.len() {
            1 => group[0].0.clone(),
            count => format!("{count} bars: {:.3} to {:.3}", group[0].1, group[last].1),
        };
        let name = move |index: usize| {
            if index == last {
                title.clone()
            } else {
                String::new()
            }
        };
        (group.iter().enumerate()).map(move |(index, bar)| (name(index), bar.1))
    });
    groups.collect()
}

/// A tenth of a unit is less than a line is wide.
fn place(coordinate: f64) -> String {
    format!("{coordinate:.1}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_nothing_beats_is_best() {
        let point = |milliseconds, error| Point {
            title: String::new(),
            milliseconds,
            error,
        };
        let all = [
            point(1.0, 0.3),
            point(2.0, 0.1),
            point(2.0, 0.2),
            point(3.0, 0.1),
        ];
        let best: Vec<bool> = all.iter().map(|own| is_best(own, &all)).collect();
        assert_eq!(best, [true, true, false, false]);
    }

    #[test]
    fn bars_that_lie_together_share_a_name() {
        let bars = [("far", 0.9), ("b", 0.52), ("a", 0.5)];
        let bars = bars.map(|(title, error)| (title.to_owned(), error));
        let labels = labelled(&bars, 1.0);
        let due = [("", 0.5), ("2 bars: 0.500 to 0.520", 0.52), ("far", 0.9)];
        assert_eq!(labels, due.map(|(title, error)| (title.to_owned(), error)));
    }
}
