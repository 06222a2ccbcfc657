//! Scores that the overview has a table of.

use metrics::Ideal;

use suite::Headline;

/// A score that has a table of its own.
pub struct ScoreTable {
    /// Score.
    pub headline: Headline,
    /// Name of the table.
    pub title: &'static str,
}

/// Tables in the order of the page.
pub const SCORE_TABLES: [ScoreTable; 9] = [
    ScoreTable {
        headline: Headline::FLIP,
        title: "FLIP",
    },
    ScoreTable {
        headline: Headline::SKILL,
        title: "Skill",
    },
    ScoreTable {
        headline: Headline::CommonFlip,
        title: "FLIP*",
    },
    ScoreTable {
        headline: Headline::SUBFRAMES,
        title: "N_eq",
    },
    ScoreTable {
        headline: Headline::GROWTH,
        title: "Growth",
    },
    ScoreTable {
        headline: Headline::LOSS,
        title: "Loss",
    },
    ScoreTable {
        headline: Headline::Bleed,
        title: "Bleed",
    },
    ScoreTable {
        headline: Headline::LABEL,
        title: "Label TV",
    },
    ScoreTable {
        headline: Headline::PSNR,
        title: "PSNR",
    },
];

impl ScoreTable {
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
