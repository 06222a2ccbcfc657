//! Table of sequences: one row per filter, with its scores over time.

use metrics::SequenceMetric;
use suite::{Sequence, printable};

use super::columns::{bracket_name, legend_text, list_once, number_table, row_style};
use crate::output::colors;

/// Columns, each with its title.
const COLUMNS: [(&str, SequenceMetric); 8] = [
    ("error", SequenceMetric::Error),
    ("flick", SequenceMetric::Flicker),
    ("along", SequenceMetric::FlickerAlong),
    ("pop", SequenceMetric::Popping),
    ("dirt", SequenceMetric::FixedPattern),
    ("JOD", SequenceMetric::Jod),
    ("error'", SequenceMetric::ErrorAfterTaa),
    ("along'", SequenceMetric::FlickerAfterTaa),
];

/// Meaning of titles.
const KEY: &str = "Sequences: roots of squared errors, in thousandths of display white. Flick: error of the \
                   change from frame to frame; along: the same along the motion; pop: largest jump of an object's error; \
                   dirt: error that stands still on the screen; JOD: quality by \
                   ColorVideoVDP, 10 at most, higher is better; ': after temporal anti-aliasing of filter and truth.";

/// Makes the table of all sequences; empty where there is none.
pub fn sequence_table(sequences: &[Sequence]) -> String {
    let Some(first) = sequences.first() else {
        return String::new();
    };
    let title = format!("{} frames", first.frames.len());
    let titles: Vec<&str> = std::iter::once(title.as_str())
        .chain(COLUMNS.iter().map(|(title, _)| *title))
        .collect();
    let mut table = number_table(&titles);
    for scene in list_once(sequences.iter().map(|own| own.scene.as_str())) {
        let of_scene = || sequences.iter().filter(|own| own.scene == scene);
        for alignment in list_once(of_scene().map(|own| own.alignment.as_str())) {
            let heading = format!("{}, {alignment} shutter", printable(scene));
            table.push_text(&colors::heading(&heading));
            for own in of_scene().filter(|own| own.alignment == alignment) {
                let name = bracket_name(&own.filter, own.is_reference);
                let scores = COLUMNS
                    .iter()
                    .map(|(_, metric)| metric.text(own.scores.get(*metric)));
                let cells = std::iter::once(name).chain(scores).collect();
                table.push_styled(cells, row_style(own.is_reference));
            }
        }
    }
    format!("\n{}{}", table.text(), legend_text(KEY))
}
