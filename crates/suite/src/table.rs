//! The table that a run prints: one line per case, 80 columns.

use std::fmt::Write;

use metrics::{ImageMetric, Measured, Metric, ObjectMetric, Region, Scores};

use crate::run::{Case, Run};

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
    let mut text = String::new();
    let mut scene = "";
    let _ = write!(text, "{:<34}", "scene / filter");
    for (title, _) in COLUMNS {
        let _ = write!(text, "{title:>7}");
    }
    text.push('\n');
    for case in &run.cases {
        if case.scene != scene {
            scene = &case.scene;
            let _ = writeln!(text, "{scene}");
        }
        line(&mut text, case);
    }
    text
}

fn line(text: &mut String, case: &Case) {
    let name = format!("{}:{}", case.filter, case.preset);
    let _ = write!(text, "  {name:<32}");
    for (_, metric) in COLUMNS {
        let _ = write!(text, "{:>7}", cell(metric, &case.scores));
    }
    text.push('\n');
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
