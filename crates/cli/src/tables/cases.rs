//! Table of a run: one row per case.

use std::fmt::Write;

use metrics::Scores;

use suite::{Case, Headline, Run, printable};

use super::columns::{
    Column, NAMES, bracket_name, dim_reference, legend_text, list_once, name_cell,
};
use super::scene_means::means_table;
use crate::output::colors;

const CASE_COLUMNS: [Column; 7] = [
    ("FLIP", 6, Headline::FLIP),
    ("skill", 6, Headline::SKILL),
    ("grow", 5, Headline::GROWTH),
    ("loss", 5, Headline::LOSS),
    ("bleed", 6, Headline::Bleed),
    ("TV", 6, Headline::LABEL),
    ("N_eq", 5, Headline::SUBFRAMES),
];
/// Width of the columns behind the scores.
const MORE_WIDTH: usize = 6;

/// Makes the table of a run: its cases, and means over the scenes. A score that does not apply is `n/a`.
pub fn run_table(run: &Run) -> String {
    let mut text = table_heading("scene / filter", &["noise", "FLIP*"]);
    for scene in list_once(run.cases.iter().map(|case| case.scene.as_str())) {
        let of_scene = || run.cases.iter().filter(|case| case.scene == scene);
        for alignment in list_once(of_scene().map(|case| case.alignment.as_str())) {
            let title = format!("{scene}, {alignment} shutter");
            let _ = writeln!(text, "{}", colors::heading(&title));
            for case in of_scene().filter(|case| case.alignment == alignment) {
                let more = [noise_cell(case), Headline::CommonFlip.text(case)];
                let row = case_row(
                    &bracket_name(&case.name(), case.is_reference),
                    &case.scores,
                    &more,
                );
                text += &dim_reference(case.is_reference, &row);
            }
        }
    }
    text += &legend_text(&format!(
        "FLIP* is against the {} shutter. {KEY}",
        run.common_alignment
    ));
    text + &means_table(&run.overall)
}

/// Meaning of titles and marks.
const KEY: &str = "Skill by FLIP: 0 is [identity], 1 is [scatter_oracle]. Bleed: the largest of beside, ahead (>) and behind \
                   (<); grow, loss and bleed in pixels.";

/// Makes the table of one picture's scores, in the manner of [`run_table`].
pub fn score_table(scene: &str, picture: &str, scores: &Scores) -> String {
    table_heading("scene / picture", &[])
        + &format!("{}\n", printable(scene))
        + &case_row(&printable(picture), scores, &[])
        + &legend_text(KEY)
}

fn table_heading(title: &str, more: &[&str]) -> String {
    let mut text = format!("{title:<NAMES$}");
    for (title, width, _) in CASE_COLUMNS {
        let _ = write!(text, "{title:>width$}");
    }
    for title in more {
        let _ = write!(text, "{title:>MORE_WIDTH$}");
    }
    colors::heading(&text) + "\n"
}

fn case_row(name: &str, scores: &Scores, more: &[String]) -> String {
    let mut text = name_cell(name);
    for (_, width, headline) in CASE_COLUMNS {
        let _ = write!(text, "{:>width$}", headline.text_of_scores(scores));
    }
    for cell in more {
        let _ = write!(text, "{cell:>MORE_WIDTH$}");
    }
    text + "\n"
}

/// Formats the part of the squared error that is the filter's noise.
fn noise_cell(case: &Case) -> String {
    let share = case.jitter.map(|jitter| 100.0 * jitter.noise_share());
    share.map_or("-".to_owned(), |share| format!("{share:.0}%"))
}
