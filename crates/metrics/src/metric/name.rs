//! Names of all scores, as files, bounds and tables use them.

use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::row::{Group, Row};
use super::rows::{
    EquivalentMetric, FrozenMetric, ImageMetric, LabelMetric, ObjectMetric, ProbeMetric,
    SkillMetric,
};
use crate::{ErrorMap, Ideal, PERFECT_JOD, Region, SequenceMetric};

/// Name of a score, unique; files store it as text and sort by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum Metric {
    /// An error of colour over a region: `flip_moving`, `psnr_full`.
    Image(ImageMetric, Region),
    /// A score of the worst moving object: `lateral_growth`.
    Object(ObjectMetric),
    /// Label total variation over the moving region: `label_tv`.
    Label(LabelMetric),
    /// `occluder_contamination`: label total variation on the worst of the objects that do not
    /// move.
    OccluderContamination,
    /// `static_contamination`: change of the picture where nothing moves.
    StaticContamination,
    /// An error against the truth with frozen shading: `mse_frozen`.
    Frozen(FrozenMetric),
    /// A score of pictures of ones and coordinates: `unity`.
    Probe(ProbeMetric),
    /// Share of the way from no blur to the one-frame oracle: `skill_flip`.
    Skill(SkillMetric),
    /// Equivalent sub-frames: `n_eq`.
    Equivalent(EquivalentMetric),
    /// A score of a sequence: `flicker`.
    Sequence(SequenceMetric),
    /// `bleed`: the largest of the bleeds to the sides of a mover, ahead of it and behind it.
    Bleed,
    /// `flip_common`, FLIP* in tables: FLIP against the shutter that all cases of a run are
    /// compared with.
    CommonFlip,
}

impl SkillMetric {
    /// Returns the error that the skill is computed from.
    pub fn error(self) -> Metric {
        match self {
            SkillMetric::Mse => Metric::Image(ImageMetric::Mse, Region::Moving),
            SkillMetric::Flip => Metric::Image(ImageMetric::Flip, Region::Moving),
            SkillMetric::LabelTotalVariation => Metric::Label(LabelMetric::Mean),
        }
    }
}

impl Metric {
    /// FLIP where anything moves.
    pub const FLIP: Metric = Metric::Image(ImageMetric::Flip, Region::Moving);
    /// Skill in FLIP.
    pub const SKILL: Metric = Metric::Skill(SkillMetric::Flip);
    /// Change where nothing moves.
    pub const STILL: Metric = Metric::StaticContamination;
    /// Grain where anything moves, without the margin.
    pub const GRAIN: Metric = Metric::Image(ImageMetric::Grain, Region::Support);
    /// PSNR where anything moves.
    pub const PSNR: Metric = Metric::Image(ImageMetric::Psnr, Region::Moving);
    /// Lateral growth.
    pub const GROWTH: Metric = Metric::Object(ObjectMetric::LateralGrowth);
    /// Row loss.
    pub const LOSS: Metric = Metric::Object(ObjectMetric::RowLoss);
    /// Mean total variation of labels.
    pub const LABEL: Metric = Metric::Label(LabelMetric::Mean);
    /// Equivalent sub-frames by squared error.
    pub const SUBFRAMES: Metric = Metric::Equivalent(EquivalentMetric::Mse);

    /// Scores that have a mean over scenes.
    pub const OF_MEANS: [Metric; 12] = [
        Metric::FLIP,
        Metric::STILL,
        Metric::GRAIN,
        Metric::CommonFlip,
        Metric::SKILL,
        Metric::Skill(SkillMetric::Mse),
        Metric::Skill(SkillMetric::LabelTotalVariation),
        Metric::PSNR,
        Metric::GROWTH,
        Metric::LOSS,
        Metric::Bleed,
        Metric::LABEL,
    ];

    /// Lists every metric of a single frame and its own shutter, in the order of a report.
    pub fn all() -> Vec<Metric> {
        let images = Region::ALL
            .into_iter()
            .flat_map(|region| ImageMetric::ALL.map(|metric| Metric::Image(metric, region)));
        images
            .chain(ObjectMetric::ALL.map(Metric::Object))
            .chain(LabelMetric::ALL.map(Metric::Label))
            .chain([Metric::OccluderContamination, Metric::StaticContamination])
            .chain(FrozenMetric::ALL.map(Metric::Frozen))
            .chain(ProbeMetric::ALL.map(Metric::Probe))
            .chain(SkillMetric::ALL.map(Metric::Skill))
            .chain(EquivalentMetric::ALL.map(Metric::Equivalent))
            .collect()
    }

    /// Returns the row of the metric. An error of colour has one row for all regions.
    pub fn row(self) -> Row {
        match self {
            Metric::Image(metric, _) => metric.row(),
            Metric::Object(metric) => metric.row(),
            Metric::Label(metric) => metric.row(),
            Metric::OccluderContamination => Row {
                name: "occluder_contamination",
                unit: "",
                ideal: Ideal::Lowest,
                group: Group::Label,
                map: ErrorMap::LabelTotalVariation,
                meaning: "share of the shutter given to the wrong object, on the worst still object",
                ..Row::USUAL
            },
            Metric::StaticContamination => Row {
                name: "static_contamination",
                unit: "brightness",
                ideal: Ideal::Lowest,
                group: Group::Seen,
                map: ErrorMap::StaticChange,
                meaning: "what the filter changes where nothing moves",
                ..Row::USUAL
            },
            Metric::Frozen(metric) => metric.row(),
            Metric::Probe(metric) => metric.row(),
            Metric::Skill(metric) => metric.row(),
            Metric::Equivalent(metric) => metric.row(),
            Metric::Sequence(metric) => metric.row(),
            Metric::Bleed => Row {
                name: "bleed",
                unit: "px",
                map: ErrorMap::Bleed,
                meaning: "mover spilled where it never was: the largest of sideways, ahead (>) and behind (<)",
                report_only: Some(
                    "is the largest of bleed_lateral, bleed_leading and bleed_trailing",
                ),
                ..Row::USUAL
            },
            Metric::CommonFlip => Row {
                name: "flip_common",
                meaning: "visible difference where anything moves, from the truth of one shutter for all",
                report_only: Some("depends on the other filters of the run"),
                ..Row::USUAL
            },
        }
    }

    /// Returns the word used in bounds, tables and files.
    pub fn name(self) -> String {
        match self {
            Metric::Image(metric, region) => format!("{}_{region}", metric.row().name),
            other => other.row().name.to_owned(),
        }
    }

    /// Returns the unit, empty for a pure number.
    pub fn unit(self) -> &'static str {
        self.row().unit
    }

    /// Returns its ideal value.
    pub fn ideal(self) -> Ideal {
        self.row().ideal
    }

    /// Explains the metric in one line; the crate's `README.md` has the formulas.
    pub fn meaning(self) -> String {
        match self {
            Metric::Image(metric, region) => {
                format!("{}, {}", metric.row().meaning, describe_region(region))
            }
            other => other.row().meaning.to_owned(),
        }
    }

    /// Returns the group in which a report shows it. A report shows most errors of colour over one
    /// region only.
    pub fn group(self) -> Group {
        match self {
            Metric::Image(metric, Region::Moving) => metric.row().group,
            Metric::Image(ImageMetric::Flip, Region::Support | Region::Still)
            | Metric::Image(ImageMetric::Grain, Region::Support) => Group::Seen,
            Metric::Image(ImageMetric::Flip, Region::Knowable | Region::Unknowable) => {
                Group::Instant
            }
            Metric::Image(..) => Group::RunJson,
            other => other.row().group,
        }
    }

    /// Returns the region in which its map is searched for the worst place.
    pub fn region(self) -> Region {
        match self {
            Metric::Image(_, region) => region,
            Metric::StaticContamination => Region::Still,
            Metric::Probe(_) => Region::Knowable,
            _ => Region::Moving,
        }
    }

    /// Returns whether scores of two shutter alignments can be compared.
    pub fn spans_alignments(self) -> bool {
        matches!(self, Metric::CommonFlip | Metric::Skill(_))
    }

    /// Reads the name of a score that bounds may limit.
    pub fn parse_bounded(text: &str) -> Result<Metric, String> {
        let metric = Metric::from_str(text)?;
        match metric.row().report_only {
            None => Ok(metric),
            Some(reason) => Err(format!("{metric} is for reports and no bound: it {reason}")),
        }
    }

    /// Writes a score or a mean of scores with as many digits as are useful: lengths with at most
    /// three.
    pub fn number(self, value: f64) -> String {
        let digits = match self {
            Self::PSNR | Self::SUBFRAMES => 1,
            Self::Skill(_) => 2,
            Self::Bleed | Self::Object(_) if value.abs() >= 9.995 => 1,
            Self::Bleed | Self::Object(_) => 2,
            _ => 3,
        };
        // Below 0, grain is none.
        let value = match self {
            Self::Image(ImageMetric::Grain, _) => value.max(0.0),
            _ => value,
        };
        // No "-0.00".
        let scale = 10f64.powi(digits);
        let rounded = (value * scale).round() / scale + 0.0;
        format!("{rounded:.*}", digits as usize)
    }

    /// Computes the strictest bound that a truth with this noise floor supports: three floors from
    /// perfect. For unbiased squared errors these are three standard deviations of a perfect
    /// picture's score, and for PSNR and grain three times the floor's square. For equivalent
    /// sub-frames it is a third of the highest count that the truth can resolve, because error
    /// falls at least as fast as the count rises.
    pub fn strictest_bound(self, floor: f64) -> f64 {
        match (self, self.ideal()) {
            (Metric::Image(ImageMetric::Psnr, _), _) => floor - 10.0 * 3f64.log10(),
            (Metric::Image(ImageMetric::Grain, _), _) => 3f64.sqrt() * floor,
            (Metric::Sequence(SequenceMetric::Jod), _) => PERFECT_JOD - 3.0 * (PERFECT_JOD - floor),
            (_, Ideal::Lowest) => 3.0 * floor,
            (_, Ideal::Highest) => floor / 3.0,
            // Distance from the target.
            (_, Ideal::Target(_)) => 3.0 * floor,
        }
    }
}

fn describe_region(region: Region) -> &'static str {
    match region {
        Region::Moving => "where anything moves",
        Region::Support => "where anything moves, without the margin",
        Region::Still => "where nothing moves",
        Region::Full => "over the whole picture",
        Region::Knowable => "where the instant shows all that the shutter saw",
        Region::Unknowable => "where the instant hides what the shutter saw",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_at_most_three_digits_and_nothing_is_minus_zero() {
        for (metric, value, expected) in [
            (Metric::GROWTH, 4.8, "4.80"),
            (Metric::GROWTH, 9.999, "10.0"),
            (Metric::Bleed, 44.44, "44.4"),
            (Metric::SKILL, -0.001, "0.00"),
            (Metric::SKILL, -0.734, "-0.73"),
            (Metric::FLIP, 0.12345, "0.123"),
            (Metric::PSNR, 27.04, "27.0"),
        ] {
            assert_eq!(metric.number(value), expected);
        }
    }
}
