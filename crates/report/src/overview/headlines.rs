//! Scores that have a table in the overview, with their explanations.

use metrics::Ideal;
use suite::Headline;

/// Scores with the titles of their tables, in the order of the page.
pub const TABLE_SCORES: [(Headline, &str); 9] = [
    (Headline::FLIP, "FLIP"),
    (Headline::SKILL, "Skill"),
    (Headline::CommonFlip, "FLIP*"),
    (Headline::SUBFRAMES, "N_eq"),
    (Headline::GROWTH, "Growth"),
    (Headline::LOSS, "Loss"),
    (Headline::Bleed, "Bleed"),
    (Headline::LABEL, "Label TV"),
    (Headline::PSNR, "PSNR"),
];

/// Explains a score in one line.
pub fn meaning(headline: Headline) -> String {
    match headline {
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

/// Names the values that are good.
pub fn better(headline: Headline) -> String {
    match headline.ideal() {
        Ideal::Lowest => "low is good".to_owned(),
        Ideal::Highest => "high is good".to_owned(),
        Ideal::Target(target) => format!("{target} is good"),
    }
}
