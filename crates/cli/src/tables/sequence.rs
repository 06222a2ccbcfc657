//! Tables of sequences: the ranking of their filters, and one row per filter and scene with all scores over time.

use judge::{RANK_RULE, RANKED_BY, RankedSequence, rank_sequences, rank_sequences_on};
use metrics::{SequenceMetric, SequenceScores};
use store::printable;
use suite::{Run, Sequence};
use tracer::SceneId;

use super::columns::{bracket_name, legend_text, list_once, number_table, row_style};
use super::layout::{Align, Table};
use super::ranking::{group_text, ranked_name};
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
const KEY: &str = "roots of squared errors, in thousandths of display white. Flick: error of the \
                   change from frame to frame; along: the same along the motion; pop: largest jump of an object's error; \
                   dirt: error that stands still on the screen; JOD: quality by \
                   ColorVideoVDP, 10 at most, higher is better; ': after temporal anti-aliasing of filter and truth.";

/// Makes the text about a run's sequences; empty where there is none. One scene has the table of its scores, several have a ranking of
/// means over the scenes, and behind it with `all` the tables of the scenes.
pub fn sequences_text(run: &Run, all: bool) -> String {
    let scenes = list_once(run.sequences.iter().map(|own| &own.scene));
    match scenes.len() {
        0 => String::new(),
        1 => sequence_table(run, &scenes),
        _ => {
            let tables = match all {
                true => sequence_table(run, &scenes),
                false => String::new(),
            };
            ranking_table(run, scenes.len()) + &tables
        }
    }
}

/// Makes the ranking of means over several scenes.
fn ranking_table(run: &Run, scenes: usize) -> String {
    let groups = rank_sequences(run);
    let title = format!("{scenes} scenes, {} frames", run.frames.count);
    let titles = [
        title.as_str(),
        "JOD",
        "95 % CI",
        "error",
        "along",
        "worst scene",
    ];
    let align = [
        Align::Left,
        Align::Right,
        Align::Right,
        Align::Right,
        Align::Right,
        Align::Left,
    ];
    let mut table = Table::new(&titles, &align);
    for group in &groups {
        table.push_text(&group_text(&group[0].ranked));
        for own in group {
            table.push(ranking_cells(own, scenes));
        }
    }
    let mut notes = "Sequences, ranked by JOD: quality by ColorVideoVDP, 10 at most, higher is better. Error: of single frames; along: of \
                     the change along the motion; both as roots, in thousandths of display white, lower is better."
        .to_owned();
    if groups.iter().flatten().any(|own| own.ranked.is_tied()) {
        notes += &format!(" {RANK_RULE}");
    }
    notes += " --table shows each scene.";
    format!("\n{}{}", table.text(), legend_text(&notes))
}

fn ranking_cells(own: &RankedSequence, scenes: usize) -> Vec<String> {
    let ranked = &own.ranked;
    let number = |value: f64| RANKED_BY.shown_text(value);
    let interval = match ranked.interval {
        Some([low, high]) => format!("{} to {}", number(low), number(high)),
        None => "-".to_owned(),
    };
    let mean = |wanted: SequenceMetric| {
        let mut means = own.means.iter();
        let found = means.find_map(|(metric, mean)| (*metric == wanted).then_some(*mean)?);
        found.map_or("n/a".to_owned(), |mean| wanted.shown_text(mean.mean))
    };
    let (scene, worst) = &ranked.worst;
    let mut worst = format!("{} {}", scene, number(*worst));
    if ranked.scenes < scenes {
        worst += &format!(" ({} of {scenes} scenes)", ranked.scenes);
    }
    vec![
        ranked_name(ranked),
        number(ranked.mean),
        interval,
        mean(SequenceMetric::Error),
        mean(SequenceMetric::FlickerAlong),
        worst,
    ]
}

/// Makes the tables of scenes: per shutter the references, then the filters by their ranks, then those without a rank.
fn sequence_table(run: &Run, scenes: &[&SceneId]) -> String {
    let title = format!("{} frames", run.sequences[0].frames.len());
    let titles: Vec<&str> = std::iter::once(title.as_str())
        .chain(COLUMNS.iter().map(|(title, _)| *title))
        .collect();
    let mut table = number_table(&titles);
    for scene in scenes {
        let of_scene = || run.sequences.iter().filter(|own| own.scene == **scene);
        let groups = rank_sequences_on(run, scene);
        for alignment in list_once(of_scene().map(|own| own.alignment)) {
            let heading = format!("{scene}, {alignment} shutter");
            table.push_text(&colors::heading(&heading));
            let of_shutter: Vec<&Sequence> = of_scene()
                .filter(|own| own.alignment == alignment)
                .collect();
            let ranked: Vec<&RankedSequence> = (groups.iter().flatten())
                .filter(|own| own.ranked.alignment == alignment)
                .collect();
            for (name, own) in order_rows(&of_shutter, &ranked) {
                let scores = COLUMNS
                    .iter()
                    .map(|(_, metric)| metric.text(own.scores.get(*metric)));
                let cells = std::iter::once(name).chain(scores).collect();
                table.push_styled(cells, row_style(own.is_reference));
            }
        }
    }
    let legend = format!("Sequences, ranked by JOD: {KEY} {RANK_RULE}");
    format!("\n{}{}", table.text(), legend_text(&legend))
}

/// Makes the table of one sequence's scores.
pub fn score_sequence_table(
    scene: &str,
    name: &str,
    frames: u32,
    scores: &SequenceScores,
) -> String {
    let title = format!("{frames} frames");
    let titles: Vec<&str> = std::iter::once(title.as_str())
        .chain(COLUMNS.iter().map(|(title, _)| *title))
        .collect();
    let mut table = number_table(&titles);
    table.push_text(&printable(scene));
    let texts = COLUMNS
        .iter()
        .map(|(_, metric)| metric.text(scores.get(*metric)));
    table.push(std::iter::once(name.to_owned()).chain(texts).collect());
    table.text() + &legend_text(&format!("Sequences: {KEY}"))
}

/// Orders the sequences of one scene and shutter, each with its name as the table shows it.
fn order_rows<'a>(
    sequences: &[&'a Sequence],
    ranked: &[&RankedSequence],
) -> Vec<(String, &'a Sequence)> {
    let references = sequences.iter().filter(|own| own.is_reference);
    let references =
        references.map(|own| (format!("    {}", bracket_name(&own.filter, true)), *own));
    let filters = || sequences.iter().filter(|own| !own.is_reference);
    let with_rank = ranked.iter().filter_map(|own| {
        let mut filters = filters();
        let sequence = filters.find(|sequence| sequence.filter == own.ranked.name)?;
        Some((ranked_name(&own.ranked), *sequence))
    });
    let has_rank = |own: &Sequence| ranked.iter().any(|it| it.ranked.name == own.filter);
    let without = filters().filter(|own| !has_rank(own));
    let without = without.map(|own| (format!("    {}", own.filter), *own));
    references.chain(with_rank).chain(without).collect()
}
