//! Tables of sequences: a ranking of filters, and one row per filter and scene with all scores over
//! time.

use judge::{RANK_RULE, RANKED_BY, RankedSequence, rank_sequences, rank_sequences_on};
use measure::{Run, Sequence};
use metrics::{SequenceMetric, SequenceScores};
use scene::SceneId;

use super::{
    Table, bracket_name, cell, legend_text, list_once, ranked_name, ranking_cells, shutter_text,
};
use terminal::output::{Text, heading};

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
const KEY: &str = "roots of squared errors, in thousandths of display white. Flick: error of the \
                   change from frame to frame; along: the same along the motion; pop: largest jump of an object's error; \
                   dirt: error that stands still on the screen; JOD: quality by \
                   ColorVideoVDP, 10 at most, higher is better; ': after temporal anti-aliasing of filter and truth.";

/// Makes the text about a run's sequences; empty without any. One scene gets its table of scores;
/// several get a ranking of means over the scenes, and with `all` the scenes' tables after it.
pub fn sequences_text(run: &Run, all: bool) -> Text {
    let scenes = list_once(run.sequences.iter().map(|sequence| &sequence.scene));
    match scenes.len() {
        0 => Text::default(),
        1 => sequence_table(run, &scenes),
        count if all => ranking_table(run, count) + sequence_table(run, &scenes),
        count => ranking_table(run, count),
    }
}

/// Makes the ranking of means over several scenes.
fn ranking_table(run: &Run, scenes: usize) -> Text {
    let groups = rank_sequences(run);
    let title = format!("{scenes} scenes, {} frames", run.frames.count);
    let titles = ["JOD", "95 % CI", "error", "along", "worst scene"];
    let mut table = Table::new(title, titles).with_words_in(5);
    for group in &groups {
        let first = &group[0].ranked;
        table.push_text(shutter_text(first.alignment, first.rate));
        for sequence in group {
            let number = |value| RANKED_BY.shown_text(value);
            let [jod, interval, worst] = ranking_cells(&sequence.ranked, scenes, number);
            let mean = |metric: SequenceMetric| {
                let mut means = sequence.means.iter();
                let mean = means.find_map(|(known, mean)| (*known == metric).then_some(*mean)?);
                cell(mean, |mean| metric.shown_text(mean.mean))
            };
            let [error, along] = [SequenceMetric::Error, SequenceMetric::FlickerAlong].map(mean);
            let cells = [jod, interval, error, along, worst];
            table.push(ranked_name(&sequence.ranked), cells);
        }
    }
    let mut notes = "Sequences, ranked by JOD: quality by ColorVideoVDP, 10 at most, higher is better. Error: of single frames; along: of \
                     the change along the motion; both as roots, in thousandths of display white, lower is better."
        .to_owned();
    if groups
        .iter()
        .flatten()
        .any(|sequence| sequence.ranked.is_tied())
    {
        notes += &format!(" {RANK_RULE}");
    }
    notes += " --table shows each scene.";
    Text::from("\n") + table.text() + legend_text(&notes)
}

/// Makes the tables of scenes: per shutter the references, then the filters by rank, then filters
/// without a rank.
fn sequence_table(run: &Run, scenes: &[&SceneId]) -> Text {
    let mut table = score_columns(run.sequences[0].frames.len());
    for scene in scenes {
        let of_scene = || {
            run.sequences
                .iter()
                .filter(|sequence| sequence.scene == **scene)
        };
        let groups = rank_sequences_on(run, scene);
        for alignment in list_once(of_scene().map(|sequence| sequence.alignment)) {
            table.push_text(heading(&format!("{scene}, {alignment} shutter")));
            let of_shutter = of_scene().filter(|sequence| sequence.alignment == alignment);
            let ranked = groups.iter().flatten();
            let ranked = ranked.filter(|sequence| sequence.ranked.alignment == alignment);
            for (name, sequence) in
                order_rows(&of_shutter.collect::<Vec<_>>(), &ranked.collect::<Vec<_>>())
            {
                table.push_row(sequence.is_reference, name, score_cells(&sequence.scores));
            }
        }
    }
    let legend = format!("Sequences, ranked by JOD: {KEY} {RANK_RULE}");
    Text::from("\n") + table.text() + legend_text(&legend)
}

/// Makes the table of one sequence's scores.
pub fn score_sequence_table(scene: &str, name: &str, frames: u32, scores: &SequenceScores) -> Text {
    let mut table = score_columns(frames as usize);
    table.push_text(scene);
    table.push(name, score_cells(scores));
    table.text() + legend_text(&format!("Sequences: {KEY}"))
}

fn score_columns(frames: usize) -> Table {
    Table::new(format!("{frames} frames"), COLUMNS.map(|(title, _)| title))
}

fn score_cells(scores: &SequenceScores) -> [String; 8] {
    COLUMNS.map(|(_, metric)| metric.text(scores.get(metric)))
}

/// Orders the sequences of one scene and shutter, each with its displayed name.
fn order_rows<'a>(
    sequences: &[&'a Sequence],
    ranked: &[&RankedSequence],
) -> Vec<(String, &'a Sequence)> {
    let mut rows = Vec::new();
    for sequence in sequences.iter().filter(|sequence| sequence.is_reference) {
        rows.push((
            format!("    {}", bracket_name(&sequence.name, true)),
            *sequence,
        ));
    }
    let filters = || sequences.iter().filter(|sequence| !sequence.is_reference);
    for RankedSequence { ranked, .. } in ranked {
        let sequence = filters().find(|sequence| sequence.name == ranked.name);
        rows.extend(sequence.map(|sequence| (ranked_name(ranked), *sequence)));
    }
    for sequence in filters().filter(|sequence| {
        !ranked
            .iter()
            .any(|entry| entry.ranked.name == sequence.name)
    }) {
        rows.push((format!("    {}", sequence.name), *sequence));
    }
    rows
}
