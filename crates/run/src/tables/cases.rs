//! Table of a run: one row per case, and failed cases.

use judge::lag_text;
use measure::{Case, Failure, Run, printable_lines};
use metrics::{Metric, Scores};

use super::{
    Column, Missing, Ranks, Table, bracket_name, csv_number, csv_table, legend_text, list_once,
    means_table,
};
use terminal::output::{Text, bad, heading, wrap_lines};

const CASE_COLUMNS: [Column; 9] = [
    ("FLIP", Metric::FLIP),
    ("still", Metric::STILL),
    ("grain", Metric::GRAIN),
    ("skill", Metric::SKILL),
    ("grow", Metric::GROWTH),
    ("loss", Metric::LOSS),
    ("bleed", Metric::Bleed),
    ("TV", Metric::LABEL),
    ("N_eq", Metric::SUBFRAMES),
];

/// Title of FLIP against the shutter that all cases share.
const COMMON_FLIP: &str = "FLIP*";

/// Makes the table of a run: cases, and means over the scenes. A score that does not apply is
/// `n/a`, with a note that says why.
pub fn run_table(run: &Run) -> Text {
    let ranks = Ranks::of(run);
    let (table, missing) = make_case_table(run, &ranks);
    let legend = format!(
        "FLIP* is against the {} shutter. {KEY}",
        run.common_alignment
    );
    let lag = lag_text(&run.cases).map_or(Text::default(), |lag| legend_text(&lag));
    table.text() + legend_text(&legend) + lag + missing.text() + means_table(&run.overall, &ranks)
}

/// Makes the table of cases as Markdown.
pub fn cases_markdown(run: &Run) -> String {
    make_case_table(run, &Ranks::of(run)).0.markdown()
}

/// Makes all scores as CSV: a row per case, a column per metric, empty where it does not apply.
pub fn cases_csv(run: &Run) -> String {
    let mut metrics = Metric::all();
    metrics
        .retain(|metric| (run.cases.iter()).any(|case| case.measured(*metric).value().is_some()));
    let names: Vec<String> = metrics.iter().map(|metric| metric.name()).collect();
    let titles = ["scene", "filter", "shutter", "is_reference"].into_iter();
    let titles: Vec<&str> = titles.chain(names.iter().map(String::as_str)).collect();
    let rows = run.cases.iter().map(|case| {
        let mut row = vec![
            case.scene.to_string(),
            case.name(),
            case.alignment.to_string(),
            case.is_reference.to_string(),
        ];
        row.extend((metrics.iter()).map(|metric| csv_number(case.measured(*metric).value())));
        row
    });
    csv_table(&titles, rows)
}

/// Makes the table of cases, and the reasons of missing scores.
fn make_case_table(run: &Run, ranks: &Ranks) -> (Table, Missing) {
    let mut table = case_table("scene / filter", &["noise", COMMON_FLIP]);
    let mut missing = Missing::default();
    let scenes = list_once(run.cases.iter().map(|case| &case.scene));
    for scene in &scenes {
        let name = scene.to_string();
        let of_scene = || run.cases.iter().filter(|case| case.scene == **scene);
        for alignment in list_once(of_scene().map(|case| case.alignment)) {
            table.push_text(heading(&format!("{scene}, {alignment} shutter")));
            for case in of_scene().filter(|case| case.alignment == alignment) {
                let row = bracket_name(&case.name(), case.is_reference);
                let more = [noise_cell(case), case.score_text(Metric::CommonFlip)];
                let columns = CASE_COLUMNS.into_iter();
                for (title, metric) in columns.chain([(COMMON_FLIP, Metric::CommonFlip)]) {
                    missing.note(title, &case.measured(metric), [&name, &row]);
                }
                // Ranks are over all scenes.
                let row = if scenes.len() == 1 {
                    ranks.name(&case.filter_id(), case.scene.rate)
                } else {
                    row
                };
                table.push_row(case.is_reference, row, case_cells(&case.scores).chain(more));
            }
        }
    }
    (table, missing)
}

/// Meaning of titles and marks.
const KEY: &str = "Skill by FLIP: 0 is a sharp picture of the shutter's middle, [identity] if centred, else [accumulate:1]; 1 is \
                   [scatter_oracle]. Bleed: the largest of sideways, ahead (>) and behind (<); grow, loss and bleed in pixels. Still: change \
                   where nothing moves; grain: noise and patterns of pixel size; both as shares of the brightness.";

/// Makes the table of one picture's scores, like [`run_table`].
pub fn score_table(scene: &str, picture: &str, scores: &Scores) -> Text {
    let mut table = case_table("scene / picture", &[]);
    table.push_text(scene);
    table.push(picture, case_cells(scores));
    table.text() + legend_text(KEY)
}

fn case_table(title: &str, more: &[&'static str]) -> Table {
    let scores = CASE_COLUMNS.iter().map(|(title, _)| *title);
    Table::new(title, scores.chain(more.iter().copied()))
}

fn case_cells(scores: &Scores) -> impl Iterator<Item = String> {
    let metrics = CASE_COLUMNS.iter().map(|(_, metric)| *metric);
    metrics.map(|metric| scores.text(metric, scores.get(metric).value()))
}

/// Formats the filter's noise as a part of the squared error.
fn noise_cell(case: &Case) -> String {
    let share = case.jitter.map(|jitter| 100.0 * jitter.noise_share());
    share.map_or("-".to_owned(), |share| format!("{share:.0}%"))
}

/// Lists every failure with its reason; empty if there is none.
pub fn failures_text(failures: &[Failure]) -> Text {
    const FAILED: &str = "FAILED";
    let mut text = Text::default();
    for failure in failures {
        let title = format!("{} / {}", failure.scene, failure.filter);
        let reason = printable_lines(&format!("  {FAILED} {}", failure.reason));
        let lines = wrap_lines(&reason);
        let (indent, rest) = (lines.split_once(FAILED)).expect("a line begins with the word");
        text += heading(&title) + "\n" + indent + bad(FAILED) + rest;
    }
    text
}
