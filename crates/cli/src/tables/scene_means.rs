//! Tables of means over scenes.

use std::fmt::Write;

use suite::{Headline, Overall, rank_filters};

use super::columns::{
    Column, NAMES, bracket_name, dim_reference, legend_text, list_once, name_cell,
};
use crate::output::colors;

/// Columns behind FLIP, which ranks filters of one alignment.
const MEAN_COLUMNS: [Column; 5] = [
    ("PSNR", 6, Headline::PSNR),
    ("grow", 5, Headline::GROWTH),
    ("loss", 5, Headline::LOSS),
    ("bleed", 6, Headline::Bleed),
    ("TV", 6, Headline::LABEL),
];
/// Columns behind skill, which ranks filters of all alignments.
const SKILL_COLUMNS: [Column; 3] = [
    ("MSE", 6, Headline::SKILL_MSE),
    ("TV", 6, Headline::SKILL_LABEL),
    ("FLIP*", 6, Headline::CommonFlip),
];
/// Width of the score that ranks.
const RANKED: usize = 6;
/// Width of its interval.
const INTERVAL: usize = 16;
/// Width of the shutter.
const SHUTTER: usize = 10;

/// Makes the tables of means, best first: by FLIP among filters of one shutter alignment, by skill among all. Empty for a single
/// scene.
pub(crate) fn means_table(overall: &[Overall]) -> String {
    let mut text = String::new();
    for group in rank_filters(overall, Headline::FLIP) {
        let first = group[0];
        if text.is_empty() {
            text += "\n";
            text += &means_heading(overall, "FLIP", &MEAN_COLUMNS, "");
        }
        let _ = writeln!(
            text,
            "{}",
            colors::heading(&format!("{} shutter", first.alignment))
        );
        for row in group {
            text += &mean_line(overall, row, Headline::FLIP, &MEAN_COLUMNS, "");
        }
    }
    for group in rank_filters(overall, Headline::SKILL) {
        text += "\n";
        text += &means_heading(overall, "skill", &SKILL_COLUMNS, "shutter");
        for row in group {
            text += &mean_line(
                overall,
                row,
                Headline::SKILL,
                &SKILL_COLUMNS,
                &row.alignment,
            );
        }
        text += &legend_text(
            "Skill is by FLIP, by MSE and by label TV: the share of the way from [identity], 0, to [scatter_oracle], 1; below 0 \
             is worse than doing nothing.",
        );
        text += &fewer_scenes_note(overall);
    }
    text
}

/// Notes the shutters for which skill applies to fewer scenes than FLIP.
fn fewer_scenes_note(overall: &[Overall]) -> String {
    let count = |headline: Headline, alignment: &str| {
        let name = headline.name();
        let mut own = overall.iter();
        let own = own.find(|mean| mean.metric == name && mean.alignment == alignment);
        own.map_or(0, |mean| mean.scenes)
    };
    let alignments = list_once(overall.iter().map(|mean| mean.alignment.as_str()));
    let counted = alignments.into_iter().filter_map(|alignment| {
        let [skill, flip] =
            [Headline::SKILL, Headline::FLIP].map(|headline| count(headline, alignment));
        (skill < flip).then(|| format!("{skill} of {flip} {alignment}"))
    });
    let counted: Vec<String> = counted.collect();
    match counted.is_empty() {
        true => String::new(),
        false => legend_text(&format!(
            "Scenes that skill applies to: {}. On the others the oracle gains no more than noise makes.",
            counted.join(", ")
        )),
    }
}

fn means_heading(overall: &[Overall], by: &str, others: &[Column], shutter: &str) -> String {
    let scenes = overall.iter().map(|mean| mean.scenes).max().unwrap_or(0);
    let mut text = format!("{:<NAMES$}", format!("mean over {scenes} scenes"));
    let _ = write!(text, "{by:>RANKED$}{:>INTERVAL$}", "95 % CI");
    for (title, width, _) in others {
        let _ = write!(text, "{title:>width$}");
    }
    if !shutter.is_empty() {
        let _ = write!(text, "{shutter:>SHUTTER$}");
    }
    colors::heading(&text) + "\n"
}

fn mean_line(
    overall: &[Overall],
    row: &Overall,
    by: Headline,
    others: &[Column],
    shutter: &str,
) -> String {
    let [low, high] = row.interval.map(|end| by.number(end));
    let mut line = name_cell(&bracket_name(&row.filter, row.is_reference));
    let _ = write!(line, "{:>RANKED$}", by.number(row.mean));
    let _ = write!(line, "{:>INTERVAL$}", format!("{low} to {high}"));
    for (_, width, headline) in others {
        let name = headline.name();
        let own = (overall.iter()).find(|mean| mean.metric == name && mean.is_of_same(row));
        let cell = own.map_or("n/a".to_owned(), |own| headline.number(own.mean));
        let _ = write!(line, "{cell:>width$}");
    }
    if !shutter.is_empty() {
        let _ = write!(line, "{shutter:>SHUTTER$}");
    }
    dim_reference(row.is_reference, &(line + "\n"))
}
