//! The table that a run prints: one line per case, 80 columns.

use std::fmt::Write;

use metrics::{ImageMetric, Measured, Metric, ObjectMetric, Region, Scores};

use crate::Case;
use crate::run::Run;

/// Columns that names take.
const NAMES: usize = 30;

const COLUMNS: [(&str, Metric); 6] = [
    ("FLIP", Metric::Image(ImageMetric::Flip, Region::Moving)),
    ("PSNR", Metric::Image(ImageMetric::Psnr, Region::Moving)),
    ("growth", Metric::Object(ObjectMetric::LateralGrowth)),
    ("bleed", Metric::Object(ObjectMetric::BleedLateral)),
    ("TV", Metric::LabelTotalVariation),
    ("N_eq", Metric::EquivalentSubframes),
];

/// The run as text; a score that does not apply is `n/a`.
pub fn table(run: &Run) -> String {
    let mut text = heading("scene / filter");
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
        text += &line(&name, &case.scores, &noise(case));
    }
    text
}

/// The scores of one picture of a scene, in the manner of [`table`].
pub fn score_table(scene: &str, picture: &str, scores: &Scores) -> String {
    heading("scene / picture") + &format!("{scene}\n") + &line(picture, scores, "")
}

fn heading(title: &str) -> String {
    let mut text = format!("{title:<NAMES$}");
    for (title, _) in COLUMNS {
        let _ = write!(text, "{title:>7}");
    }
    text + "  noise\n"
}

fn line(name: &str, scores: &Scores, noise: &str) -> String {
    let mut text = format!("  {name:<0$}", NAMES - 2);
    if name.len() > NAMES - 2 {
        // A long name has a line of its own.
        text += &format!("\n{:<NAMES$}", "");
    }
    for (_, metric) in COLUMNS {
        let _ = write!(text, "{:>7}", cell(metric, scores));
    }
    text += &format!("{noise:>7}");
    text.trim_end().to_owned() + "\n"
}

/// The part of the squared error that is the filter's noise.
fn noise(case: &Case) -> String {
    let share = case.jitter.map(|jitter| 100.0 * jitter.noise_share());
    share.map_or("-".to_owned(), |share| format!("{share:.0}%"))
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
