//! The tables of means over scenes that a run prints, in 80 columns.

use std::fmt::Write;

use super::cases::{Column, NAMES, behind, legend, name_cell, once, titled};
use crate::output::paint;
use suite::Headline;
use suite::Overall;
use suite::rank_filters;

/// Behind the score that filters of one alignment are rank_filters by.
const OF_MEANS: [Column; 5] = [
    ("PSNR", 6, Headline::PSNR),
    ("grow", 5, Headline::GROWTH),
    ("loss", 5, Headline::LOSS),
    ("bleed", 6, Headline::Bleed),
    ("TV", 6, Headline::LABEL),
];
/// Behind the skill that filters of all alignments are rank_filters by.
const OF_SKILLS: [Column; 3] = [
    ("MSE", 6, Headline::SKILL_MSE),
    ("TV", 6, Headline::SKILL_LABEL),
    ("FLIP*", 6, Headline::CommonFlip),
];
/// Of the score that is rank_filters by.
const RANKED: usize = 6;
/// Of its interval.
const INTERVAL: usize = 16;
const SHUTTER: usize = 10;

/// Means over scenes, and who is best: among filters of one shutter alignment by Headline::FLIP, among all by skill. Nothing of a single
/// scene.
pub(crate) fn means_table(overall: &[Overall]) -> String {
    let mut text = String::new();
    for group in rank_filters(overall, Headline::FLIP) {
        let first = group[0];
        if text.is_empty() {
            text += "\n";
            text += &means_heading(overall, "FLIP", &OF_MEANS, "");
        }
        let _ = writeln!(
            text,
            "{}",
            paint::heading(&format!("{} shutter", first.alignment))
        );
        for row in group {
            text += &mean_line(overall, row, Headline::FLIP, &OF_MEANS, "");
        }
    }
    for group in rank_filters(overall, Headline::SKILL) {
        text += "\n";
        text += &means_heading(overall, "skill", &OF_SKILLS, "shutter");
        for row in group {
            text += &mean_line(overall, row, Headline::SKILL, &OF_SKILLS, &row.alignment);
        }
        text += &legend(
            "Skill is by Headline::FLIP, by MSE and by label TV: the share of the way from [identity], 0, to [scatter_oracle], 1; below 0 \
             is worse than doing nothing.",
        );
        text += &fewer_scenes(overall);
    }
    text
}

/// On which shutters skill by Headline::FLIP has fewer scenes than Headline::FLIP.
fn fewer_scenes(overall: &[Overall]) -> String {
    let count = |headline: Headline, alignment: &str| {
        let name = headline.name();
        let mut own = overall.iter();
        let own = own.find(|mean| mean.metric == name && mean.alignment == alignment);
        own.map_or(0, |mean| mean.scenes)
    };
    let alignments = once(overall.iter().map(|mean| mean.alignment.as_str()));
    let counted = alignments.into_iter().filter_map(|alignment| {
        let [skill, flip] =
            [Headline::SKILL, Headline::FLIP].map(|headline| count(headline, alignment));
        (skill < flip).then(|| format!("{skill} of {flip} {alignment}"))
    });
    let counted: Vec<String> = counted.collect();
    match counted.is_empty() {
        true => String::new(),
        false => legend(&format!(
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
    paint::heading(&text) + "\n"
}

fn mean_line(
    overall: &[Overall],
    row: &Overall,
    by: Headline,
    others: &[Column],
    shutter: &str,
) -> String {
    let [low, high] = row.interval.map(|end| by.number(end));
    let mut line = name_cell(&titled(&row.filter, row.is_reference));
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
    behind(row.is_reference, &(line + "\n"))
}
