//! Tables of means over scenes.

use frame::Alignment;
use metrics::{Metric, SkillMetric};
use suite::{Overall, rank_filters};

use super::{Column, Table, bracket_name, cell, legend_text, list_once, range_text, shutter_text};
use crate::output::heading;

/// Columns behind FLIP, which ranks filters of one alignment.
const MEAN_COLUMNS: [Column; 5] = [
    ("PSNR", Metric::PSNR),
    ("grow", Metric::GROWTH),
    ("loss", Metric::LOSS),
    ("bleed", Metric::Bleed),
    ("TV", Metric::LABEL),
];
/// Columns behind skill, which ranks filters of all alignments.
const SKILL_COLUMNS: [Column; 3] = [
    ("MSE", Metric::Skill(SkillMetric::Mse)),
    ("TV", Metric::Skill(SkillMetric::LabelTotalVariation)),
    ("FLIP*", Metric::CommonFlip),
];
/// Makes the tables of means, best first: by FLIP among filters of one shutter alignment, by skill among all. Empty for a single
/// scene.
pub fn means_table(overall: &[Overall]) -> String {
    let groups = rank_filters(overall, Metric::FLIP);
    if groups.is_empty() {
        return String::new();
    }
    let mut by_flip = begin_means(overall, "FLIP", &MEAN_COLUMNS, None);
    for group in groups {
        let shutter = shutter_text(group[0].alignment, group[0].rate);
        by_flip.push_text(heading(&shutter));
        for row in group {
            push_mean(
                &mut by_flip,
                overall,
                row,
                (Metric::FLIP, &MEAN_COLUMNS),
                None,
            );
        }
    }
    let mut text = format!("\n{}", by_flip.text());
    for group in rank_filters(overall, Metric::SKILL) {
        let mut by_skill = begin_means(overall, "skill", &SKILL_COLUMNS, Some("shutter"));
        if let Some(rate) = group[0].rate {
            by_skill.push_text(heading(&rate.text()));
        }
        for row in group {
            let last = Some(row.alignment.name());
            push_mean(
                &mut by_skill,
                overall,
                row,
                (Metric::SKILL, &SKILL_COLUMNS),
                last,
            );
        }
        text += &format!("\n{}", by_skill.text());
        text += &legend_text(
            "Skill is by FLIP, by MSE and by label TV: the share of the way from a sharp picture of the shutter's middle, 0 \
             ([identity] if centred, else [accumulate:1]), to [scatter_oracle], 1.",
        );
        text += &fewer_scenes_note(overall);
    }
    text
}

/// Notes the shutters for which skill applies to fewer scenes than FLIP.
fn fewer_scenes_note(overall: &[Overall]) -> String {
    let count = |metric: Metric, alignment: Alignment| {
        let mut own = overall.iter();
        let own = own.find(|mean| mean.metric == metric && mean.alignment == alignment);
        own.map_or(0, |mean| mean.scenes)
    };
    let alignments = list_once(overall.iter().map(|mean| mean.alignment));
    let counted = alignments.into_iter().filter_map(|alignment| {
        let [skill, flip] = [Metric::SKILL, Metric::FLIP].map(|metric| count(metric, alignment));
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

fn begin_means(overall: &[Overall], by: &str, others: &[Column], last: Option<&str>) -> Table {
    let scenes = overall.iter().map(|mean| mean.scenes).max().unwrap_or(0);
    let others = others.iter().map(|(title, _)| *title);
    let titles = [by, "95 % CI"].into_iter().chain(others).chain(last);
    Table::new(format!("mean over {scenes} scenes"), titles)
}

/// Adds a row: the mean that ranks with its interval, other means, and a last cell.
fn push_mean(
    table: &mut Table,
    overall: &[Overall],
    row: &Overall,
    (by, others): (Metric, &[Column]),
    last: Option<&str>,
) {
    let number = |value| by.number(value);
    let mut cells = vec![number(row.mean), range_text(row.interval, number)];
    for (_, metric) in others {
        let mut own = overall.iter().filter(|mean| mean.is_of_same(row));
        let mean = own.find(|mean| mean.metric == *metric);
        cells.push(cell(mean, |mean| metric.number(mean.mean)));
    }
    cells.extend(last.map(str::to_owned));
    let name = bracket_name(&row.filter, row.is_reference);
    table.push_row(row.is_reference, name, cells);
}
