//! The scores of the overview.

use metrics::Ideal;

use suite::Headline;

/// A score that has a table of its own.
pub struct Shown {
    /// Which.
    pub headline: Headline,
    /// What its table is called.
    pub title: &'static str,
}

/// Every table, in the order of the page.
pub const SHOWN: [Shown; 9] = [
    Shown {
        headline: Headline::FLIP,
        title: "FLIP",
    },
    Shown {
        headline: Headline::SKILL,
        title: "Skill",
    },
    Shown {
        headline: Headline::CommonFlip,
        title: "FLIP*",
    },
    Shown {
        headline: Headline::SUBFRAMES,
        title: "N_eq",
    },
    Shown {
        headline: Headline::GROWTH,
        title: "Growth",
    },
    Shown {
        headline: Headline::LOSS,
        title: "Loss",
    },
    Shown {
        headline: Headline::Bleed,
        title: "Bleed",
    },
    Shown {
        headline: Headline::LABEL,
        title: "Label TV",
    },
    Shown {
        headline: Headline::PSNR,
        title: "PSNR",
    },
];

impl Shown {
    /// What it says, in one line.
    pub fn meaning(&self) -> String {
        match self.headline {
            Headline::Metric(metric) => metric.meaning(),
            Headline::Bleed => {
                "mover spilled where it never was: the largest of beside, ahead (>) and behind (<)"
                    .to_owned()
            }
            Headline::CommonFlip => {
                "visible difference where anything moves, from the truth of one shutter for all"
                    .to_owned()
            }
        }
    }

    /// Which values are good.
    pub fn better(&self) -> String {
        match self.headline.ideal() {
            Ideal::Lowest => "low is good".to_owned(),
            Ideal::Highest => "high is good".to_owned(),
            Ideal::Target(target) => format!("{target} is good"),
        }
    }
}
