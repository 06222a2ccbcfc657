//! The table that a run prints: one line per case, 80 columns.

use std::fmt::Write;

use metrics::{ImageMetric, Measured, Metric, ObjectMetric, Region, Scores};

use crate::Case;
use crate::run::Run;

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
/// Of the columns that a run has beside the scores.
const WIDTH: usize = 6;

/// The run as text; a score that does not apply is `n/a`.
pub fn table(run: &Run) -> String {
    let mut text = heading("scene / filter", &["noise", "FLIP*"]);
    let mut scene = "";
    for case in &run.cases {
        if case.scene != scene {
            scene = &case.scene;
            let _ = writeln!(text, "{scene}");
        }
        let name = match case.bar {
            // Bars come first, and are made anew for every alignment that a filter has.
            true => format!("{} ({})", case.name(), case.alignment),
            false => case.name(),
        };
        text += &line(&name, &case.scores, &[noise(case), common(case)]);
    }
    text
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
    text + "\n"
}

fn line(name: &str, scores: &Scores, more: &[String]) -> String {
    let mut text = format!("  {name:<0$}", NAMES - 2);
    if name.chars().count() > NAMES - 2 {
        // A long name has a line of its own.
        text += &format!("\n{:<NAMES$}", "");
    }
    for (_, width, metric) in COLUMNS {
        let _ = write!(text, "{:>width$}", cell(metric, scores));
    }
    for cell in more {
        let _ = write!(text, "{cell:>WIDTH$}");
    }
    text + "\n"
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
