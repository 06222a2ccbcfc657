//! Scores that the overview has a table of, with their words.

use metrics::Ideal;

use suite::Headline;

/// A score that has a table of its own.
pub struct TableScore {
    /// Score.
    pub headline: Headline,
    /// Name of the table.
    pub title: &'static str,
}

/// Tables in the order of the page.
pub const TABLE_SCORES: [TableScore; 9] = [
    TableScore {
        headline: Headline::FLIP,
        title: "FLIP",
    },
    TableScore {
        headline: Headline::SKILL,
        title: "Skill",
    },
    TableScore {
        headline: Headline::CommonFlip,
        title: "FLIP*",
    },
    TableScore {
        headline: Headline::SUBFRAMES,
        title: "N_eq",
    },
    TableScore {
        headline: Headline::GROWTH,
        title: "Growth",
    },
    TableScore {
        headline: Headline::LOSS,
        title: "Loss",
    },
    TableScore {
        headline: Headline::Bleed,
        title: "Bleed",
    },
    TableScore {
        headline: Headline::LABEL,
        title: "Label TV",
    },
    TableScore {
        headline: Headline::PSNR,
        title: "PSNR",
    },
];

impl TableScore {
    /// Explains the score in one line.
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

    /// Tells which values are good.
    pub fn better(&self) -> String {
        match self.headline.ideal() {
            Ideal::Lowest => "low is good".to_owned(),
            Ideal::Highest => "high is good".to_owned(),
            Ideal::Target(target) => format!("{target} is good"),
        }
    }
}
