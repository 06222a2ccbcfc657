//! Scores that the overview has a table of, with their words.

use metrics::{Ideal, Metric};

/// A score that has a table of its own.
pub struct TableScore {
    /// Score.
    pub metric: Metric,
    /// Name of the table.
    pub title: &'static str,
}

/// Tables in the order of the page.
pub const TABLE_SCORES: [TableScore; 9] = [
    TableScore {
        metric: Metric::FLIP,
        title: "FLIP",
    },
    TableScore {
        metric: Metric::SKILL,
        title: "Skill",
    },
    TableScore {
        metric: Metric::CommonFlip,
        title: "FLIP*",
    },
    TableScore {
        metric: Metric::SUBFRAMES,
        title: "N_eq",
    },
    TableScore {
        metric: Metric::GROWTH,
        title: "Growth",
    },
    TableScore {
        metric: Metric::LOSS,
        title: "Loss",
    },
    TableScore {
        metric: Metric::Bleed,
        title: "Bleed",
    },
    TableScore {
        metric: Metric::LABEL,
        title: "Label TV",
    },
    TableScore {
        metric: Metric::PSNR,
        title: "PSNR",
    },
];

impl TableScore {
    /// Tells which values are good.
    pub fn better(&self) -> String {
        match self.metric.ideal() {
            Ideal::Lowest => "low is good".to_owned(),
            Ideal::Highest => "high is good".to_owned(),
            Ideal::Target(target) => format!("{target} is good"),
        }
    }
}
