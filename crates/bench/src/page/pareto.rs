//! Chart of error against time, and the filters that no other beats in both.

use maud::{Markup, html};
use report::charts::is_undominated;
use report::charts::plot::{Axis, Plot};
use report::numbers::three_digits;
use report::table::Column::Plain;
use report::table::scroll_table;

use super::times::{milliseconds, spread};
use crate::Spread;

/// Width of a label's letter, and height of its line, in the chart's units.
const LETTER: f64 = 5.8;
const LINE: f64 = 11.0;

/// A timed filter.
pub struct Point {
    pub title: String,
    /// Time of all its passes.
    pub seconds: Spread,
    /// Mean FLIP where anything moves, against one shutter for all.
    pub error: f64,
}

impl Point {
    /// Time in milliseconds, and error.
    fn place(&self) -> [f64; 2] {
        [1e3 * self.seconds.median, self.error]
    }

    /// Ends of the bar of quartiles.
    fn bar(&self) -> [(f64, f64); 2] {
        [self.seconds.lower_quartile, self.seconds.upper_quartile]
            .map(|seconds| (1e3 * seconds, self.error))
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
    // Unbeaten filters are named first: labels without room are left out.
    sorted.sort_by(|(a, a_leads), (b, b_leads)| {
        let times = a.seconds.median.total_cmp(&b.seconds.median);
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
    let bars = || points.iter().flat_map(|(point, _)| point.bar());
    let errors =
        (references.iter().map(|reference| reference.1)).chain(bars().map(|(_, error)| error));
    let plot = Plot {
        size: [640.0, 380.0],
        x: Axis::log("ms, logarithmic", bars().map(|(time, _)| time)),
        y: Axis::linear("mean FLIP*", errors.chain([0.0])),
    };
    let end = plot.size[0] - 12.0;
    let levels = named_levels(references, 0.05 * plot.y.high).into_iter();
    let levels: Vec<(String, f64, f64)> = levels
        .map(|(title, error)| (title, error, plot.place(plot.x.low, error).1 - 3.0))
        .collect();
    let names_of_levels = levels.iter().map(|(title, _, y)| {
        let left = end - text_width(title);
        [left, y + 2.0 - LINE, end, y + 2.0]
    });
    let labels: Vec<(&str, [f64; 4])> = (points.iter())
        .map(|(point, _)| {
            let [time, error] = point.place();
            let (x, y) = plot.place(time, error);
            let [left, right] = point.bar().map(|(time, error)| plot.place(time, error).0);
            let disc = [left.min(x - 5.0), y - 5.0, right.max(x + 5.0), y + 5.0];
            (point.title.as_str(), disc)
        })
        .collect();
    let corners = place_labels(&labels, names_of_levels.collect(), plot.size[0]);
    let marks = html! {
        @for (title, error, y) in &levels {
            (plot.level("reference", *error))
            text.reference x=(end) y=(format!("{y:.1}")) text-anchor="end" { (title) }
        }
        @for (point, leads) in points {
            (plot.line("quartiles", &point.bar()))
            (plot.mark(point.place().into(), if *leads { "" } else { "faint" }, 4.5, &words(point)))
        }
        @for ((title, _), corner) in labels.iter().zip(corners) {
            @if let Some([left, top]) = corner {
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
                (spread(&point.seconds))
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
    scroll_table(
        None,
        "Quality against time",
        None,
        &["filter", "ms", "quartiles", "mean FLIP*", "undominated"].map(Plain),
        &rows,
    )
}

fn words(point: &Point) -> String {
    let (time, error) = (
        milliseconds(point.seconds.median),
        three_digits(point.error),
    );
    format!("{}: {time} ms, FLIP* {error}", point.title)
}

fn text_width(text: &str) -> f64 {
    LETTER * text.chars().count() as f64
}

/// Finds the upper left corner of every label: next to its disc, where it covers no disc, no other
/// label and nothing in `taken`; none if there is no room.
fn place_labels(
    discs: &[(&str, [f64; 4])],
    mut taken: Vec<[f64; 4]>,
    width: f64,
) -> Vec<Option<[f64; 2]>> {
    taken.extend(discs.iter().map(|(_, disc)| disc));
    let free = |label: &[f64; 4], taken: &[[f64; 4]]| {
        let apart = |other: &[f64; 4]| {
            label[2] <= other[0]
                || other[2] <= label[0]
                || label[3] <= other[1]
                || other[3] <= label[1]
        };
        label[0] >= 60.0 && label[2] <= width && label[1] >= 0.0 && taken.iter().all(apart)
    };
    let place = |(title, [left, top, right, bottom]): &(&str, [f64; 4])| {
        let length = text_width(title);
        let beside = f64::midpoint(*top, *bottom) - LINE / 2.0;
        let center = f64::midpoint(*left, *right);
        let (above, below) = (top - 2.0 - LINE, bottom + 1.0);
        let columns = [center - length / 2.0, center + 4.0, center + 4.0 - length];
        let corners = [[right + 2.0, beside], [left - 2.0 - length, beside]].into_iter();
        let corners = corners.chain(columns.into_iter().flat_map(|x| [[x, above], [x, below]]));
        let mut boxes = corners.map(|[left, top]| [left, top, left + length, top + LINE]);
        let label = boxes.find(|label| free(label, &taken))?;
        taken.push(label);
        Some([label[0], label[1]])
    };
    discs.iter().map(place).collect()
}

/// Sorts references, lowest first. Of lines closer than `near` only the top one has a name, which
/// combines all of them.
fn named_levels(references: &[(String, f64)], near: f64) -> Vec<(String, f64)> {
    let mut sorted = references.to_vec();
    sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
    for group in sorted.chunk_by_mut(|a, b| b.1 - a.1 < near) {
        if let [first, .., last] = &*group {
            let (count, low, high) = (group.len(), first.1, last.1);
            group.iter_mut().for_each(|reference| reference.0.clear());
            group[count - 1].0 = format!("{count} references: {low:.3} to {high:.3}");
        }
    }
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_near_one_another_share_a_name() {
        let named = |all: [(&str, f64); 3]| all.map(|(title, error)| (title.to_owned(), error));
        let references = named([("far", 0.9), ("b", 0.52), ("a", 0.5)]);
        let range = "2 references: 0.500 to 0.520";
        let expected = named([("", 0.5), (range, 0.52), ("far", 0.9)]);
        assert_eq!(named_levels(&references, 0.05), expected);
    }

    #[test]
    fn labels_cover_neither_points_nor_one_another() {
        let disc = |x: f64, y: f64| ("jump_flood:paper", [x - 5.0, y - 5.0, x + 5.0, y + 5.0]);
        let discs = [disc(200.0, 100.0), disc(208.0, 100.0), disc(204.0, 102.0)];
        let labels = place_labels(&discs, Vec::new(), 640.0);
        assert!(labels[0].is_some());
        assert!(
            labels[0] != labels[1] && labels[1] != labels[2],
            "{labels:?}"
        );
        assert_eq!(place_labels(&[disc(70.0, -20.0)], Vec::new(), 90.0), [None]);
    }
}
