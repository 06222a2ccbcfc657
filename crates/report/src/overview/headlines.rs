//! Scores that have a table in the overview, with their explanations.

use metrics::{Ideal, Metric};

/// Scores with the titles of their tables, in the order of the page.
pub const TABLE_SCORES: [(Metric, &str); 9] = [
    (Metric::FLIP, "FLIP"),
    (Metric::SKILL, "Skill"),
    (Metric::CommonFlip, "FLIP*"),
    (Metric::SUBFRAMES, "N_eq"),
    (Metric::GROWTH, "Growth"),
    (Metric::LOSS, "Loss"),
    (Metric::Bleed, "Bleed"),
    (Metric::LABEL, "Label TV"),
    (Metric::PSNR, "PSNR"),
];

/// Names the values that are good.
pub fn better(metric: Metric) -> String {
    match metric.ideal() {
        Ideal::Lowest => "low is good".to_owned(),
        Ideal::Highest => "high is good".to_owned(),
        Ideal::Target(target) => format!("{target} is good"),
    }
}
