//! The table that a run prints: one line per case, 80 columns.

use std::fmt::Write;

use metrics::{ImageMetric, Measured, Metric, ObjectMetric, Region, Scores};

use crate::run::Run;
use crate::{Case, Overall, paint};

/// Columns that names take.
const NAMES: usize = 29;

/// Title and width.
const COLUMNS: [(&str, usize, Metric); 6] = [
    ("FLIP", 6, Metric::Image(ImageMetric::Flip, Region::Moving)),
    ("PSNR", 6, Metric::Image(ImageMetric::Psnr, Region::Moving)),
    ("growth", 7, Metric::Object(ObjectMetric::LateralGrowth)),
    ("bleed", 7, Metric::Object(ObjectMetric::BleedLateral)),
    ("TV", 6, Metric::LabelTotalVariation),
    ("N_eq", 6, Metric::EquivalentSubframes),
];
/// So many of them, from the first, have a mean over scenes.
const MEANS: usize = 5;
/// Width of the column of intervals.
const INTERVAL: usize = 13;
/// Of the columns that a run has beside the scores.
const WIDTH: usize = 6;

/// The run as text; a score that does not apply is `n/a`.
pub fn table(run: &Run) -> String {
    let mut text = heading("scene / filter", &["noise", "FLIP*"]);
    let mut scene = "";
    for case in &run.cases {
        if case.scene != scene {
            scene = &case.scene;
            let _ = writeln!(text, "{}", paint::heading(scene));
        }
        let line = line(
            &with_alignment(&case.name(), case.bar, &case.alignment),
            &case.scores,
            &[noise(case), common(case)],
        );
        text += &behind(case.bar, &line);
    }
    text + &over_scenes(&run.overall)
}

/// Means over scenes, the best FLIP first; nothing of a single scene.
fn over_scenes(overall: &[Overall]) -> String {
    let [first, others @ ..] = &COLUMNS[..MEANS] else {
        unreachable!("there are columns");
    };
    let of = |metric: Metric| {
        let name = metric.name();
        (overall.iter()).filter(move |mean| mean.metric == name)
    };
    let mut ranked: Vec<&Overall> = of(first.2).collect();
    ranked.sort_by(|a, b| a.mean.total_cmp(&b.mean));
    let Some(best) = ranked.first() else {
        return String::new();
    };
    let mut text = format!("{:<NAMES$}", format!("mean over {} scenes", best.scenes));
    let _ = write!(text, "{:>1$}{2:>INTERVAL$}", first.0, first.1, "95 % in");
    for (title, width, _) in others {
        let _ = write!(text, "{title:>width$}");
    }
    let mut text = paint::heading(&text) + "\n";
    for row in ranked {
        let [low, high] = row.interval;
        let mut line = name_cell(&with_alignment(&row.filter, row.bar, &row.alignment));
        let _ = write!(line, "{:>1$.3}", row.mean, first.1);
        let _ = write!(line, "{:>INTERVAL$}", format!("{low:.3}-{high:.3}"));
        for (_, width, metric) in others {
            let own = of(*metric).find(|mean| mean.is_of_same(row));
            let cell = own.map_or("n/a".to_owned(), |own| {
                format!("{:.*}", digits(*metric), own.mean)
            });
            let _ = write!(line, "{cell:>width$}");
        }
        line += "\n";
        text += &behind(row.bar, &line);
    }
    text
}

/// Bars come first, and are made anew for every alignment that a filter has.
fn with_alignment(name: &str, bar: bool, alignment: &str) -> String {
    match bar {
        true => format!("{name} ({alignment})"),
        false => name.to_owned(),
    }
}

/// The scores of one picture of a scene, in the manner of [`table`].
pub fn score_table(scene: &str, picture: &str, scores: &Scores) -> String {
    heading("scene / picture", &[]) + &format!("{scene}\n") + &line(picture, scores, &[])
}

fn heading(title: &str, more: &[&str]) -> String {
    let mut text = format!("{title:<NAMES$}");
    for (title, width, _) in COLUMNS {
        let _ = write!(text, "{title:>width$}");
    }
    for title in more {
        let _ = write!(text, "{title:>WIDTH$}");
    }
    paint::heading(&text) + "\n"
}

/// Bars are no filters, and stand behind.
fn behind(bar: bool, lines: &str) -> String {
    match bar {
        true => paint::faint(lines),
        false => lines.to_owned(),
    }
}

fn line(name: &str, scores: &Scores, more: &[String]) -> String {
    let mut text = name_cell(name);
    for (_, width, metric) in COLUMNS {
        let _ = write!(text, "{:>width$}", cell(metric, scores));
    }
    for cell in more {
        let _ = write!(text, "{cell:>WIDTH$}");
    }
    text + "\n"
}

/// A long name has a line of its own.
fn name_cell(name: &str) -> String {
    match name.chars().count() > NAMES - 2 {
        true => format!("  {name}\n{:<NAMES$}", ""),
        false => format!("  {name:<0$}", NAMES - 2),
    }
}

/// The part of the squared error that is the filter's noise.
fn noise(case: &Case) -> String {
    let share = case.jitter.map(|jitter| 100.0 * jitter.noise_share());
    share.map_or("-".to_owned(), |share| format!("{share:.0}%"))
}

/// FLIP against the shutter that all cases are compared with.
fn common(case: &Case) -> String {
    match &case.common.flip {
        Measured::NotApplicable { .. } => "n/a".to_owned(),
        Measured::Score(score) => format!("{:.3}", score.value),
    }
}

fn cell(metric: Metric, scores: &Scores) -> String {
    if metric == Metric::EquivalentSubframes {
        return scores.equivalent_subframes.mse.to_string();
    }
    match scores.get(metric) {
        Measured::NotApplicable { .. } => "n/a".to_owned(),
        Measured::Score(score) => format!("{:.*}", digits(metric), score.value),
    }
}

fn digits(metric: Metric) -> usize {
    match metric {
        Metric::Image(ImageMetric::Psnr, _) => 1,
        Metric::Object(_) => 2,
        _ => 3,
    }
}
