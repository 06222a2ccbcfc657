//! The scores of the overview.

use metrics::{Ideal, ImageMetric, Measured, Metric, ObjectMetric, Region};

use crate::Case;

/// A score that has a table of its own.
pub struct Shown {
    /// Which.
    pub metric: Metric,
    /// What its table is called.
    pub title: &'static str,
    /// Digits behind the point.
    pub digits: usize,
}

/// Every table, in the order of the page.
pub const SHOWN: [Shown; 6] = [
    Shown {
        metric: Metric::Image(ImageMetric::Flip, Region::Moving),
        title: "FLIP",
        digits: 3,
    },
    Shown {
        metric: Metric::EquivalentSubframes,
        title: "N_eq",
        digits: 1,
    },
    Shown {
        metric: Metric::Object(ObjectMetric::LateralGrowth),
        title: "Growth",
        digits: 2,
    },
    Shown {
        metric: Metric::Object(ObjectMetric::BleedLateral),
        title: "Bleed",
        digits: 2,
    },
    Shown {
        metric: Metric::LabelTotalVariation,
        title: "Label TV",
        digits: 3,
    },
    Shown {
        metric: Metric::Image(ImageMetric::Psnr, Region::Moving),
        title: "PSNR",
        digits: 1,
    },
];

impl Shown {
    /// A case's score as text: `0.063`, `<1`, `n/a`.
    pub fn text(&self, case: &Case) -> String {
        if self.metric == Metric::EquivalentSubframes {
            return case.scores.equivalent_subframes.mse.to_string();
        }
        match case.scores.get(self.metric) {
            Measured::Score(score) => format!("{:.*}", self.digits, score.value),
            Measured::NotApplicable { .. } => "n/a".to_owned(),
        }
    }

    /// Which values are good.
    pub fn better(&self) -> String {
        match self.metric.ideal() {
            Ideal::Lowest => "low is good".to_owned(),
            Ideal::Highest => "high is good".to_owned(),
            Ideal::Target(target) => format!("{target} is good"),
        }
    }
}
