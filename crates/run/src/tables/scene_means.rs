//! Tables of means over scenes.

use frame::Alignment;
use measure::{Overall, rank_filters};
use metrics::{Metric, SkillMetric};

use super::{
    Column, Ranks, Table, bracket_name, cell, legend_text, list_once, range_text, shutter_text,
};
use terminal::output::{Text, heading};

/// FLIP, which ranks filters of one alignment, and the columns after it.
const BY_FLIP: [Column; 8] = [
    ("FLIP", Metric::FLIP),
    ("still", Metric::STILL),
    ("grain", Metric::GRAIN),
    ("PSNR", Metric::PSNR),
    ("grow", Metric::GROWTH),
    ("loss", Metric::LOSS),
    ("bleed", Metric::Bleed),
    ("TV", Metric::LABEL),
];
/// Skill, which ranks filters of all alignments, and the columns after it.
const BY_SKILL: [Column; 4] = [
    ("skill", Metric::SKILL),
    ("MSE", Metric::Skill(SkillMetric::Mse)),
    ("TV", Metric::Skill(SkillMetric::LabelTotalVariation)),
    ("FLIP*", Metric::CommonFlip),
];

/// Makes the tables of means, best first: by FLIP among filters of one shutter alignment, with
/// their ranks, and by skill among all. Empty for a single scene.
pub fn means_table(overall: &[Overall], ranks: &Ranks) -> Text {
    let groups = rank_filters(overall, Metric::FLIP);
    if groups.is_empty() {
        return Text::default();
    }
    let mut by_flip = begin_means(overall, &BY_FLIP, None);
    for group in groups {
        let shutter = shutter_text(group[0].alignment, group[0].rate);
        by_flip.push_text(heading(&shutter));
        for row in group {
            let name = ranks.name(&row.filter, row.rate);
            push_mean(&mut by_flip, overall, (name, row), &BY_FLIP, None);
        }
    }
    let mut text = Text::from("\n") + by_flip.text();
    for group in rank_filters(overall, Metric::SKILL) {
        let mut by_skill = begin_means(overall, &BY_SKILL, Some("shutter"));
        if let Some(rate) = group[0].rate {
            by_skill.push_text(heading(&rate.text()));
        }
        for row in group {
            let last = Some(row.alignment.name());
            let name = bracket_name(&row.name, row.is_reference);
            push_mean(&mut by_skill, overall, (name, row), &BY_SKILL, last);
        }
        text += Text::from("\n") + by_skill.text();
        text += legend_text(
            "Skill is by FLIP, by MSE and by label TV: the share of the way from a sharp picture of the shutter's middle, 0 \
             ([identity] if centred, else [accumulate:1]), to [scatter_oracle], 1.",
        );
        text += fewer_scenes_note(overall);
    }
    text
}

/// Notes the shutters where skill applies to fewer scenes than FLIP.
fn fewer_scenes_note(overall: &[Overall]) -> Text {
    let count = |metric: Metric, alignment: Alignment| {
        let mut means = overall.iter();
        let mean = means.find(|mean| mean.metric == metric && mean.alignment == alignment);
        mean.map_or(0, |mean| mean.scenes)
    };
    let alignments = list_once(overall.iter().map(|mean| mean.alignment));
    let counted = alignments.into_iter().filter_map(|alignment| {
        let [skill, flip] = [Metric::SKILL, Metric::FLIP].map(|metric| count(metric, alignment));
        (skill < flip).then(|| format!("{skill} of {flip} {alignment}"))
    });
    let counted: Vec<String> = counted.collect();
    if counted.is_empty() {
        Text::default()
    } else {
        legend_text(&format!(
            "Scenes that skill applies to: {}. On the others the oracle gains no more than noise makes.",
            counted.join(", ")
        ))
    }
}

fn begin_means(overall: &[Overall], columns: &[Column], last: Option<&str>) -> Table {
    let scenes = overall.iter().map(|mean| mean.scenes).max().unwrap_or(0);
    let mut titles: Vec<&str> = columns.iter().map(|(title, _)| *title).collect();
    titles.insert(1, "95 % CI");
    titles.extend(last);
    Table::new(format!("mean over {scenes} scenes"), titles)
}

/// Adds a row: the ranking mean with its interval, other means, and a last cell.
fn push_mean(
    table: &mut Table,
    overall: &[Overall],
    (name, row): (String, &Overall),
    columns: &[Column],
    last: Option<&str>,
) {
    let (_, by) = columns[0];
    let number = |value| by.number(value);
    let mut cells = vec![number(row.mean), range_text(row.interval, number)];
    for (_, metric) in &columns[1..] {
        let mut means = overall.iter().filter(|mean| mean.is_of_same(row));
        let mean = means.find(|mean| mean.metric == *metric);
        cells.push(cell(mean, |mean| metric.number(mean.mean)));
    }
    cells.extend(last.map(str::to_owned));
    table.push_row(row.is_reference, name, cells);
}
