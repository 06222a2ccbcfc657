//! Chart of error against time, and the filters that no other one beats in both.

use maud::{Markup, html};

use crate::charts::plot::{Axis, Plot};
use crate::numbers::three_digits;

/// Width of a letter of a label, and height of its line, in the chart's units.
const LETTER: f64 = 5.8;
const LINE: f64 = 11.0;

/// A filter that was timed.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Name of the filter.
    pub title: String,
    /// Time of all its passes: median and quartiles.
    pub milliseconds: f64,
    /// Lower and upper quartile of the time.
    pub quartiles: [f64; 2],
    /// Mean FLIP where anything moves, against one shutter for all.
    pub error: f64,
}

/// Tells whether no other point is as fast and as good, and better in one of both.
pub fn is_undominated(point: &Point, all: &[Point]) -> bool {
    let beats = |other: &Point| {
        other.milliseconds <= point.milliseconds
            && other.error <= point.error
            && (other.milliseconds, other.error) != (point.milliseconds, point.error)
    };
    !all.iter().any(beats)
}

/// Draws filters as discs with their names, and references as lines; below it the same numbers as a table.
pub fn pareto_chart(points: &[Point], references: &[(String, f64)]) -> Markup {
    if points.is_empty() {
        return html! {
            p { "None of the run's filters was timed with the parameters that it ran with." }
        };
    }
    let mut sorted = points.to_vec();
    // Filters that nothing beats are named first: labels that find no room are left out.
    sorted.sort_by(|a, b| {
        let beaten = |point| !is_undominated(point, points);
        (beaten(a), a.milliseconds)
            .partial_cmp(&(beaten(b), b.milliseconds))
            .expect("times are numbers")
    });
    let plot = make_plot(points, references);
    let places: Vec<(f64, f64)> = (sorted.iter())
        .map(|point| plot.place(point.milliseconds, point.error))
        .collect();
    let levels = named_levels(references, 0.05 * plot.y.high);
    let end = plot.size[0] - 12.0;
    let level_height = |error: f64| plot.place(plot.x.low, error).1;
    let names_of_levels = levels.iter().map(|(title, error)| {
        let bottom = level_height(*error) - 1.0;
        [end - text_width(title), bottom - LINE, end, bottom]
    });
    let bars: Vec<[f64; 4]> = (sorted.iter())
        .map(|point| {
            let [(left, y), (right, _)] = point.quartiles.map(|time| plot.place(time, point.error));
            [left, y - 2.0, right, y + 2.0]
        })
        .chain(names_of_levels)
        .collect();
    let marks = html! {
        @for (title, error) in &levels {
            (plot.level("reference", *error))
            text.reference x=(end) y=(format!("{:.1}", level_height(*error) - 3.0)) text-anchor="end" { (title) }
        }
        @for point in &sorted {
            @let class = if is_undominated(point, points) { "" } else { "faint" };
            (plot.line("quartiles", &point.quartiles.map(|time| (time, point.error))))
            (plot.mark((point.milliseconds, point.error), class, 4.5, &words(point)))
        }
        @for (point, label) in sorted.iter().zip(place_labels(&sorted, &places, &bars, plot.size[0])) {
            @if let Some([left, top]) = label {
                text.name x=(format!("{left:.1}")) y=(format!("{:.1}", top + LINE - 2.0)) { (point.title) }
            }
        }
    };
    html! {
        figure.pareto {
            (plot.draw("Mean FLIP* against time; the table below has the numbers", &marks))
            figcaption {
                "Down and left is good. Blue: no other filter is both as fast and as good. Horizontal bars: quartiles of the time. "
                "Dashed lines: references, which have no time. FLIP* is FLIP against one shutter for all filters."
            }
        }
        div.scroll tabindex="0" role="region" aria-label="Quality against time" {
            table {
                caption.unseen { "Quality and time" }
                thead {
                    tr {
                        th scope="col" { "filter" }
                        th scope="col" { "ms" }
                        th scope="col" { "quartiles" }
                        th scope="col" { "mean FLIP*" }
                        th scope="col" { "undominated" }
                    }
                }
                tbody {
                    @for point in &sorted {
                        tr {
                            th scope="row" { (point.title) }
                            td { (three_digits(point.milliseconds)) }
                            td { (three_digits(point.quartiles[0])) "–" (three_digits(point.quartiles[1])) }
                            td { (three_digits(point.error)) }
                            td { @if is_undominated(point, points) { "✓" } }
                        }
                    }
                    @for (title, error) in references {
                        tr.reference {
                            th scope="row" { (title) }
                            td { "-" }
                            td { "-" }
                            td { (three_digits(*error)) }
                            td {}
                        }
                    }
                }
            }
        }
    }
}

fn make_plot(points: &[Point], references: &[(String, f64)]) -> Plot {
    let times =
        (points.iter()).flat_map(|point| point.quartiles.into_iter().chain([point.milliseconds]));
    let errors = (points.iter().map(|point| point.error)).chain(references.iter().map(|own| own.1));
    let wide = Plot::wide(
        Axis::log("ms, logarithmic", times),
        Axis::linear("mean FLIP*", errors.chain([0.0])),
    );
    Plot {
        size: [wide.size[0], 380.0],
        ..wide
    }
}

fn words(point: &Point) -> String {
    let [time, error] = [point.milliseconds, point.error].map(three_digits);
    format!("{}: {time} ms, FLIP* {error}", point.title)
}

fn text_width(text: &str) -> f64 {
    LETTER * text.chars().count() as f64
}

/// Finds the upper left corner of every label: beside its point, where it covers no point, no bar and no other label; none where
/// there is no room. The first bars are the points' own, in their order.
fn place_labels(
    points: &[Point],
    places: &[(f64, f64)],
    bars: &[[f64; 4]],
    width: f64,
) -> Vec<Option<[f64; 2]>> {
    let discs = places.iter();
    let mut taken: Vec<[f64; 4]> = discs
        .map(|(x, y)| [x - 5.0, y - 5.0, x + 5.0, y + 5.0])
        .chain(bars.iter().copied())
        .collect();
    let free = |own: &[f64; 4], taken: &[[f64; 4]]| {
        let apart = |other: &[f64; 4]| {
            own[2] <= other[0] || other[2] <= own[0] || own[3] <= other[1] || other[3] <= own[1]
        };
        own[0] >= 60.0 && own[2] <= width && own[1] >= 0.0 && taken.iter().all(apart)
    };
    let mut labels = Vec::new();
    for (index, (point, (x, y))) in points.iter().zip(places).enumerate() {
        let length = text_width(&point.title);
        let [start, _, end, _] = bars.get(index).copied().unwrap_or([*x, *y, *x, *y]);
        let (middle, above, below) = (y - LINE / 2.0, y - 7.0 - LINE, y + 6.0);
        let corners = [
            [end.max(x + 3.0) + 4.0, middle],
            [start.min(x - 3.0) - 4.0 - length, middle],
            [x - length / 2.0, above],
            [x - length / 2.0, below],
            [x + 4.0, above],
            [x + 4.0, below],
            [x - length + 4.0, above],
            [x - length + 4.0, below],
        ];
        let found = corners
            .map(|[left, top]| [left, top, left + length, top + LINE])
            .into_iter()
            .find(|own| free(own, &taken));
        taken.extend(found);
        labels.push(found.map(|[left, top, ..]| [left, top]));
    }
    labels
}

/// Sorts references, lowest first. Of lines nearer than `near` only the uppermost has a name, which is that of all.
fn named_levels(references: &[(String, f64)], near: f64) -> Vec<(String, f64)> {
    let mut sorted = references.to_vec();
    sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
    let are_near = |a: &(String, f64), b: &(String, f64)| b.1 - a.1 < near;
    let groups = sorted.chunk_by(are_near).flat_map(|group| {
        let last = group.len() - 1;
        let title = match group.len() {
            1 => group[0].0.clone(),
            count => format!(
                "{count} references: {:.3} to {:.3}",
                group[0].1, group[last].1
            ),
        };
        let name = move |index: usize| (index == last).then(|| title.clone());
        (group.iter().enumerate()).map(move |(index, own)| (name(index).unwrap_or_default(), own.1))
    });
    groups.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(milliseconds: f64, error: f64) -> Point {
        Point {
            title: "jump_flood:paper".to_owned(),
            milliseconds,
            quartiles: [milliseconds; 2],
            error,
        }
    }

    #[test]
    fn a_filter_that_another_one_beats_is_dominated() {
        let all = [(1.0, 0.3), (2.0, 0.1), (2.0, 0.2), (3.0, 0.1)];
        let all = all.map(|(time, error)| point(time, error));
        let best: Vec<bool> = (all.iter()).map(|own| is_undominated(own, &all)).collect();
        assert_eq!(best, [true, true, false, false]);
    }

    #[test]
    fn references_that_lie_together_share_a_name() {
        let references = [("far", 0.9), ("b", 0.52), ("a", 0.5)];
        let references = references.map(|(title, error)| (title.to_owned(), error));
        let levels = named_levels(&references, 0.05);
        let due = [
            ("", 0.5),
            ("2 references: 0.500 to 0.520", 0.52),
            ("far", 0.9),
        ];
        assert_eq!(levels, due.map(|(title, error)| (title.to_owned(), error)));
    }

    #[test]
    fn labels_cover_neither_points_nor_one_another() {
        let points = vec![point(1.0, 1.0); 3];
        let labels = place_labels(
            &points,
            &[(200.0, 100.0), (208.0, 100.0), (204.0, 102.0)],
            &[],
            640.0,
        );
        assert!(labels[0].is_some());
        assert!(
            labels[0] != labels[1] && labels[1] != labels[2],
            "{labels:?}"
        );
        assert_eq!(
            place_labels(&points[..1], &[(70.0, -20.0)], &[], 90.0),
            [None]
        );
    }
}
