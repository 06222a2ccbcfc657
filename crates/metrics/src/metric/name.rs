//! Names of all metrics, as bounds and tables use them.

use std::fmt;
use std::str::FromStr;

use super::row::{Group, Row};
use super::rows::{
    EquivalentMetric, FrozenMetric, ImageMetric, LabelMetric, ObjectMetric, ProbeMetric,
    SkillMetric,
};
use crate::{ErrorMap, Ideal, Region};

/// Name of a score.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Metric {
    /// An error of colour over a region: `flip_moving`, `psnr_full`.
    Image(ImageMetric, Region),
    /// A score of the worst moving object: `lateral_growth`.
    Object(ObjectMetric),
    /// Label total variation over the moving region: `label_tv`.
    Label(LabelMetric),
    /// `occluder_contamination`: label total variation on the worst of the objects that stand still.
    OccluderContamination,
    /// `static_contamination`: change of the picture where nothing moves.
    StaticContamination,
    /// An error against the truth whose shading stands still: `mse_frozen`.
    Frozen(FrozenMetric),
    /// A score of pictures of ones and coordinates: `unity`.
    Probe(ProbeMetric),
    /// Share of the way from no blur to the one-frame oracle: `skill_flip`.
    Skill(SkillMetric),
    /// Equivalent sub-frames: `n_eq`.
    Equivalent(EquivalentMetric),
}

impl ObjectMetric {
    /// Hard bleed on all sides: beside, ahead and behind.
    pub const BLEEDS: [ObjectMetric; 3] = [
        ObjectMetric::BleedLateral,
        ObjectMetric::BleedLeading,
        ObjectMetric::BleedTrailing,
    ];
}

impl SkillMetric {
    /// Returns the error that it is the skill of.
    pub fn error(self) -> Metric {
        match self {
            SkillMetric::Mse => Metric::Image(ImageMetric::Mse, Region::Moving),
            SkillMetric::Flip => Metric::Image(ImageMetric::Flip, Region::Moving),
            SkillMetric::LabelTotalVariation => Metric::Label(LabelMetric::Mean),
        }
    }
}

impl Metric {
    /// Equivalent sub-frames by squared error: the headline.
    pub const SUBFRAMES: Metric = Metric::Equivalent(EquivalentMetric::Mse);

    /// Lists every metric, in the order of a report.
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
                meaning: "share of the shutter given to the wrong object, on the worst object that stands still",
                is_percentile: false,
                report_only: None,
            },
            Metric::StaticContamination => Row {
                name: "static_contamination",
                unit: "white",
                ideal: Ideal::Lowest,
                group: Group::Seen,
                map: ErrorMap::StaticChange,
                meaning: "what the filter changes where nothing moves",
                is_percentile: false,
                report_only: None,
            },
            Metric::Frozen(metric) => metric.row(),
            Metric::Probe(metric) => metric.row(),
            Metric::Skill(metric) => metric.row(),
            Metric::Equivalent(metric) => metric.row(),
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

    /// Explains the metric in one line; `README.md` beside this crate has the formulas.
    pub fn meaning(self) -> String {
        match self {
            Metric::Image(metric, region) => {
                format!("{}, {}", metric.row().meaning, describe_region(region))
            }
            other => other.row().meaning.to_owned(),
        }
    }

    /// Returns the group in which a report shows it. A report shows most errors of colour over one region only.
    pub fn group(self) -> Group {
        match self {
            Metric::Image(metric, Region::Moving) => metric.row().group,
            Metric::Image(ImageMetric::Flip, Region::Support | Region::Still) => Group::Seen,
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
            Metric::Object(_)
            | Metric::Label(_)
            | Metric::OccluderContamination
            | Metric::Frozen(_)
            | Metric::Skill(_)
            | Metric::Equivalent(_) => Region::Moving,
        }
    }

    /// Returns the reason why no bound may name this metric; `None` for metrics that may be bounded.
    pub fn report_only(self) -> Option<&'static str> {
        self.row().report_only
    }

    /// Computes the strictest bound that a truth with this noise floor can carry: three floors from perfect. For unbiased squared
    /// errors these are three standard deviations of a perfect picture's score, and for PSNR three times the floor's squared error.
    /// For equivalent sub-frames it is a third of the highest count that the truth can tell, because error falls at least as fast
    /// as the count rises.
    pub fn strictest_bound(self, floor: f64) -> f64 {
        match (self, self.ideal()) {
            (Metric::Image(ImageMetric::Psnr, _), _) => floor - 10.0 * 3f64.log10(),
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

impl fmt::Display for Metric {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.name())
    }
}

impl FromStr for Metric {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let all = Metric::all();
        all.iter()
            .copied()
            .find(|metric| metric.name() == text)
            .ok_or_else(|| {
                let names: Vec<String> = all.iter().map(|metric| metric.name()).collect();
                format!(
                    "metric \"{text}\" is unknown; allowed: {}",
                    names.join(", ")
                )
            })
    }
}
