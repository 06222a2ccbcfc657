//! Chart of error against time, and the filters that no other one beats in both.

use maud::{Markup, html};

use crate::charts::is_undominated;
use crate::charts::plot::{Axis, Plot};
use crate::numbers::three_digits;
use crate::table::Column::Plain;
use crate::table::scroll_table;

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

impl Point {
    fn place(&self) -> [f64; 2] {
        [self.milliseconds, self.error]
    }
}

/// Shows quality against time as a chart, and the same numbers as a table.
pub fn pareto_section(points: &[Point], references: &[(String, f64)]) -> Markup {
    if points.is_empty() {
        return html! {
            p { "None of the run's filters was timed with the parameters that it ran with." }
        };
    }
    let places: Vec<[f64; 2]> = points.iter().map(Point::place).collect();
    let with_front = (points.iter()).map(|point| (point, is_undominated(point.place(), &places)));
    let mut sorted: Vec<(&Point, bool)> = with_front.collect();
    // Filters that nothing beats are named first: labels that find no room are left out.
    sorted.sort_by(|(a, a_leads), (b, b_leads)| {
        let times = a.milliseconds.total_cmp(&b.milliseconds);
        b_leads.cmp(a_leads).then(times)
    });
    html! {
        figure.pareto {
            (chart(&sorted, references))
            figcaption {
                "Down and left is good. Blue: no other filter is both as fast and as good. Horizontal bars: quartiles of the time. "
                "Dashed lines: references, which have no time. FLIP* is FLIP against one shutter for all filters."
            }
        }
        (numbers(&sorted, references))
    }
}

/// Draws filters as discs with their names, and references as lines.
fn chart(points: &[(&Point, bool)], references: &[(String, f64)]) -> Markup {
    let plot = make_plot(points, references);
    let levels = named_levels(references, 0.05 * plot.y.high);
    let end = plot.size[0] - 12.0;
    let level_height = |error: f64| plot.place(plot.x.low, error).1;
    let names_of_levels = levels.iter().map(|(title, error)| {
        let bottom = level_height(*error) - 1.0;
        [end - text_width(title), bottom - LINE, end, bottom]
    });
    let bars = points.iter().map(|(point, _)| {
        let [(left, y), (right, _)] = point.quartiles.map(|time| plot.place(time, point.error));
        [left, y - 2.0, right, y + 2.0]
    });
    let bars: Vec<[f64; 4]> = bars.chain(names_of_levels).collect();
    let named: Vec<(&str, (f64, f64))> = (points.iter())
        .map(|(point, _)| {
            (
                point.title.as_str(),
                plot.place(point.milliseconds, point.error),
            )
        })
        .collect();
    let marks = html! {
        @for (title, error) in &levels {
            (plot.level("reference", *error))
            text.reference x=(end) y=(format!("{:.1}", level_height(*error) - 3.0)) text-anchor="end" { (title) }
        }
        @for (point, leads) in points {
            (plot.line("quartiles", &point.quartiles.map(|time| (time, point.error))))
            (plot.mark(point.place().into(), if *leads { "" } else { "faint" }, 4.5, &words(point)))
        }
        @for ((title, _), label) in named.iter().zip(place_labels(&named, &bars, plot.size[0])) {
            @if let Some([left, top]) = label {
                text.name x=(format!("{left:.1}")) y=(format!("{:.1}", top + LINE - 2.0)) { (title) }
            }
        }
    };
    plot.draw(
        "Mean FLIP* against time; the table below has the numbers",
        &marks,
    )
}

fn numbers(points: &[(&Point, bool)], references: &[(String, f64)]) -> Markup {
    let rows = html! {
        @for (point, leads) in points {
            tr {
                th scope="row" { (point.title) }
                td { (three_digits(point.milliseconds)) }
                td { (three_digits(point.quartiles[0])) "–" (three_digits(point.quartiles[1])) }
                td { (three_digits(point.error)) }
                td { @if *leads { "✓" } }
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
    };
    html! {
        (scroll_table(None, "Quality against time", None, &[
            Plain("filter"), Plain("ms"), Plain("quartiles"), Plain("mean FLIP*"), Plain("undominated"),
        ], &rows))
    }
}

fn make_plot(points: &[(&Point, bool)], references: &[(String, f64)]) -> Plot {
    let points = || points.iter().map(|(point, _)| point);
    let times = points().flat_map(|point| point.quartiles.into_iter().chain([point.milliseconds]));
    let errors = points()
        .map(|point| point.error)
        .chain(references.iter().map(|own| own.1));
    Plot {
        size: [640.0, 380.0],
        x: Axis::log("ms, logarithmic", times),
        y: Axis::linear("mean FLIP*", errors.chain([0.0])),
    }
}

fn words(point: &Point) -> String {
    let [time, error] = [point.milliseconds, point.error].map(three_digits);
    format!("{}: {time} ms, FLIP* {error}", point.title)
}

fn text_width(text: &str) -> f64 {
    LETTER * text.chars().count() as f64
}

/// Finds the upper left corner of every label: next to its point, where it covers no point, no bar and no other label; none where
/// there is no room. The first bars are the points' own, in their order.
fn place_labels(
    points: &[(&str, (f64, f64))],
    bars: &[[f64; 4]],
    width: f64,
) -> Vec<Option<[f64; 2]>> {
    let discs = (points.iter()).map(|(_, (x, y))| [x - 5.0, y - 5.0, x + 5.0, y + 5.0]);
    let mut taken: Vec<[f64; 4]> = discs.chain(bars.iter().copied()).collect();
    let free = |own: &[f64; 4], taken: &[[f64; 4]]| {
        let apart = |other: &[f64; 4]| {
            own[2] <= other[0] || other[2] <= own[0] || own[3] <= other[1] || other[3] <= own[1]
        };
        own[0] >= 60.0 && own[2] <= width && own[1] >= 0.0 && taken.iter().all(apart)
    };
    let mut labels = Vec::new();
    for (index, (title, (x, y))) in points.iter().enumerate() {
        let length = text_width(title);
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

    #[test]
    fn references_that_lie_together_share_a_name() {
        let references = [("far", 0.9), ("b", 0.52), ("a", 0.5)];
        let references = references.map(|(title, error)| (title.to_owned(), error));
        let levels = named_levels(&references, 0.05);
        let expected = [
            ("", 0.5),
            ("2 references: 0.500 to 0.520", 0.52),
            ("far", 0.9),
        ];
        assert_eq!(
            levels,
            expected.map(|(title, error)| (title.to_owned(), error))
        );
    }

    #[test]
    fn labels_cover_neither_points_nor_one_another() {
        let title = "jump_flood:paper";
        let points = [(200.0, 100.0), (208.0, 100.0), (204.0, 102.0)].map(|place| (title, place));
        let labels = place_labels(&points, &[], 640.0);
        assert!(labels[0].is_some());
        assert!(
            labels[0] != labels[1] && labels[1] != labels[2],
            "{labels:?}"
        );
        assert_eq!(place_labels(&[(title, (70.0, -20.0))], &[], 90.0), [None]);
    }
}
