//! The name, unit and direction of every score.

use std::fmt;
use std::str::FromStr;

use crate::{Ideal, Region};

/// A score by name, as bounds and tables address it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Metric {
    /// An error of colour over a region: `flip_moving`, `psnr_full`.
    Image(ImageMetric, Region),
    /// A score of the worst moving object: `lateral_growth`.
    Object(ObjectMetric),
    /// `label_tv`: mean over the moving region.
    LabelTotalVariation,
    /// `label_tv_p95`.
    LabelTotalVariationP95,
    /// `occluder_contamination`: label total variation on the worst of the objects that stand still.
    OccluderContamination,
    /// `static_contamination`: what a picture changes where nothing moves.
    StaticContamination,
    /// Against the truth whose shading stands still: `mse_frozen`.
    Frozen(FrozenMetric),
    /// Of pictures of ones and coordinates: `unity`.
    Probe(ProbeMetric),
    /// Share of the way from doing nothing to the one-frame oracle: `skill_flip`.
    Skill(SkillMetric),
    /// `n_eq`: by squared error, the headline.
    EquivalentSubframes,
    /// `n_eq_flip`.
    EquivalentSubframesFlip,
    /// `n_eq_label_tv`.
    EquivalentSubframesLabel,
}

/// An error of colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ImageMetric {
    /// Unbiased mean squared error.
    Mse,
    /// Peak signal to noise ratio.
    Psnr,
    /// Unbiased relative squared error.
    Relmse,
    /// Mean absolute error.
    Mae,
    /// Symmetric mean absolute percentage error.
    Smape,
    /// Mean LDR-FLIP.
    Flip,
    /// LDR-FLIP's median, each pixel weighted by its FLIP.
    FlipWeightedMedian,
    /// 95th percentile of LDR-FLIP.
    FlipP95,
    /// 99th percentile of LDR-FLIP.
    FlipP99,
    /// Mean HDR-FLIP.
    FlipHdr,
    /// Structural similarity; reported, never bounded.
    Ssim,
}

/// A score of one object's matte.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ObjectMetric {
    /// Hard bleed beside the support.
    BleedLateral,
    /// Hard bleed ahead of it.
    BleedLeading,
    /// Hard bleed behind it.
    BleedTrailing,
    /// Growth across the motion.
    LateralGrowth,
    /// Mass that rows along the motion gain.
    RowGain,
    /// Mass that they lose.
    RowLoss,
    /// Wasserstein distance along the motion.
    Misplacement,
    /// Signed shift along the motion.
    Centroid,
    /// Length ratio along the motion.
    Extent,
    /// Steps, ripples and noise along the motion.
    TvExcess,
    /// Holes where nothing else is seen.
    Hole,
    /// Missing mass.
    Deficit,
    /// Mass ratio.
    Energy,
    /// Label total variation on the object.
    LabelTotalVariation,
    /// Squared difference of the gradients' magnitudes.
    GradientError,
}

/// An error against the frozen-shading truth, over the moving region.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrozenMetric {
    /// Unbiased mean squared error.
    Mse,
    /// Mean LDR-FLIP.
    Flip,
    /// Squared difference of the two truths: no picture takes part in it.
    Shading,
}

/// What a filter makes of pictures of ones and of coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ProbeMetric {
    /// Sum of the weights, against 1.
    Unity,
    /// Mean place that is gathered from.
    GatherOffset,
    /// Spread of the places that are gathered from.
    GatherSpread,
}

/// Share of the way from doing nothing to the one-frame oracle, over the moving region.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SkillMetric {
    /// By unbiased squared error.
    Mse,
    /// By mean LDR-FLIP.
    Flip,
    /// By mean label total variation.
    LabelTotalVariation,
}

impl ImageMetric {
    /// Every error of colour.
    pub const ALL: [ImageMetric; 11] = [
        ImageMetric::Mse,
        ImageMetric::Psnr,
        ImageMetric::Relmse,
        ImageMetric::Mae,
        ImageMetric::Smape,
        ImageMetric::Flip,
        ImageMetric::FlipWeightedMedian,
        ImageMetric::FlipP95,
        ImageMetric::FlipP99,
        ImageMetric::FlipHdr,
        ImageMetric::Ssim,
    ];

    /// Name, unit and ideal.
    fn describe(self) -> (&'static str, &'static str, Ideal) {
        match self {
            ImageMetric::Mse => ("mse", "white^2", Ideal::Lowest),
            ImageMetric::Psnr => ("psnr", "dB", Ideal::Highest),
            ImageMetric::Relmse => ("relmse", "", Ideal::Lowest),
            ImageMetric::Mae => ("mae", "white", Ideal::Lowest),
            ImageMetric::Smape => ("smape", "", Ideal::Lowest),
            ImageMetric::Flip => ("flip", "", Ideal::Lowest),
            ImageMetric::FlipWeightedMedian => ("flip_weighted_median", "", Ideal::Lowest),
            ImageMetric::FlipP95 => ("flip_p95", "", Ideal::Lowest),
            ImageMetric::FlipP99 => ("flip_p99", "", Ideal::Lowest),
            ImageMetric::FlipHdr => ("flip_hdr", "", Ideal::Lowest),
            ImageMetric::Ssim => ("ssim", "", Ideal::Highest),
        }
    }

    /// Which way it is better.
    pub fn ideal(self) -> Ideal {
        self.describe().2
    }
}

impl ObjectMetric {
    /// Every score of a matte.
    pub const ALL: [ObjectMetric; 15] = [
        ObjectMetric::BleedLateral,
        ObjectMetric::BleedLeading,
        ObjectMetric::BleedTrailing,
        ObjectMetric::LateralGrowth,
        ObjectMetric::RowGain,
        ObjectMetric::RowLoss,
        ObjectMetric::Misplacement,
        ObjectMetric::Centroid,
        ObjectMetric::Extent,
        ObjectMetric::TvExcess,
        ObjectMetric::Hole,
        ObjectMetric::Deficit,
        ObjectMetric::Energy,
        ObjectMetric::LabelTotalVariation,
        ObjectMetric::GradientError,
    ];

    /// Hard bleed on all sides: beside, ahead and behind.
    pub const BLEEDS: [ObjectMetric; 3] = [
        ObjectMetric::BleedLateral,
        ObjectMetric::BleedLeading,
        ObjectMetric::BleedTrailing,
    ];

    /// Name, unit and ideal.
    fn describe(self) -> (&'static str, &'static str, Ideal) {
        match self {
            ObjectMetric::BleedLateral => ("bleed_lateral", "px", Ideal::Lowest),
            ObjectMetric::BleedLeading => ("bleed_leading", "px", Ideal::Lowest),
            ObjectMetric::BleedTrailing => ("bleed_trailing", "px", Ideal::Lowest),
            ObjectMetric::LateralGrowth => ("lateral_growth", "px", Ideal::Lowest),
            ObjectMetric::RowGain => ("row_gain", "px", Ideal::Lowest),
            ObjectMetric::RowLoss => ("row_loss", "px", Ideal::Lowest),
            ObjectMetric::Misplacement => ("misplacement", "px", Ideal::Lowest),
            ObjectMetric::Centroid => ("centroid", "px", Ideal::Target(0.0)),
            ObjectMetric::Extent => ("extent", "", Ideal::Target(1.0)),
            ObjectMetric::TvExcess => ("tv_excess", "", Ideal::Target(0.0)),
            ObjectMetric::Hole => ("hole", "", Ideal::Target(0.0)),
            ObjectMetric::Deficit => ("deficit", "", Ideal::Lowest),
            ObjectMetric::Energy => ("energy", "", Ideal::Target(1.0)),
            ObjectMetric::LabelTotalVariation => ("object_label_tv", "", Ideal::Lowest),
            ObjectMetric::GradientError => ("gradient_error", "1/px^2", Ideal::Lowest),
        }
    }

    /// Which way it is better.
    pub fn ideal(self) -> Ideal {
        self.describe().2
    }
}

impl FrozenMetric {
    fn describe(self) -> (&'static str, &'static str, Ideal) {
        match self {
            FrozenMetric::Mse => ("mse_frozen", "white^2", Ideal::Lowest),
            FrozenMetric::Flip => ("flip_frozen", "", Ideal::Lowest),
            FrozenMetric::Shading => ("mse_shading", "white^2", Ideal::Lowest),
        }
    }
}

impl ProbeMetric {
    fn describe(self) -> (&'static str, &'static str, Ideal) {
        match self {
            ProbeMetric::Unity => ("unity", "", Ideal::Lowest),
            ProbeMetric::GatherOffset => ("gather_offset", "px", Ideal::Lowest),
            ProbeMetric::GatherSpread => ("gather_spread", "px", Ideal::Lowest),
        }
    }
}

impl SkillMetric {
    /// The error that it is the skill of.
    pub fn error(self) -> Metric {
        match self {
            SkillMetric::Mse => Metric::Image(ImageMetric::Mse, Region::Moving),
            SkillMetric::Flip => Metric::Image(ImageMetric::Flip, Region::Moving),
            SkillMetric::LabelTotalVariation => Metric::LabelTotalVariation,
        }
    }

    fn describe(self) -> (&'static str, &'static str, Ideal) {
        match self {
            SkillMetric::Mse => ("skill_mse", "", Ideal::Highest),
            SkillMetric::Flip => ("skill_flip", "", Ideal::Highest),
            SkillMetric::LabelTotalVariation => ("skill_label_tv", "", Ideal::Highest),
        }
    }
}

impl Metric {
    /// Every metric, in the order of a report.
    pub fn all() -> Vec<Metric> {
        let images = Region::ALL
            .into_iter()
            .flat_map(|region| ImageMetric::ALL.map(|metric| Metric::Image(metric, region)));
        let wholes = [
            Metric::LabelTotalVariation,
            Metric::LabelTotalVariationP95,
            Metric::OccluderContamination,
            Metric::StaticContamination,
            Metric::Frozen(FrozenMetric::Mse),
            Metric::Frozen(FrozenMetric::Flip),
            Metric::Frozen(FrozenMetric::Shading),
            Metric::Probe(ProbeMetric::Unity),
            Metric::Probe(ProbeMetric::GatherOffset),
            Metric::Probe(ProbeMetric::GatherSpread),
            Metric::Skill(SkillMetric::Mse),
            Metric::Skill(SkillMetric::Flip),
            Metric::Skill(SkillMetric::LabelTotalVariation),
            Metric::EquivalentSubframes,
            Metric::EquivalentSubframesFlip,
            Metric::EquivalentSubframesLabel,
        ];
        images
            .chain(ObjectMetric::ALL.map(Metric::Object))
            .chain(wholes)
            .collect()
    }

    /// The word used in bounds, tables and files.
    pub fn name(self) -> String {
        match self {
            Metric::Image(metric, region) => format!("{}_{region}", metric.describe().0),
            other => other.describe().0.to_owned(),
        }
    }

    /// The unit, empty for a pure number.
    pub fn unit(self) -> &'static str {
        self.describe().1
    }

    /// Which way it is better.
    pub fn ideal(self) -> Ideal {
        self.describe().2
    }

    /// Why no bound may name this metric; none for those that may be bounded.
    pub fn report_only(self) -> Option<&'static str> {
        match self {
            Metric::Image(ImageMetric::Ssim, _) => Some(
                "punishes unbiased noise more than a picture that lies three pixels off; bound flip instead",
            ),
            Metric::Skill(_) => {
                Some("a grey ghost over everything has skill; bound the error itself, or n_eq")
            }
            Metric::Frozen(FrozenMetric::Shading) => {
                Some("is a property of the scene, whatever the filter does")
            }
            _ => None,
        }
    }

    /// The strictest bound that a truth with this noise floor can carry: three floors away from perfect. For unbiased squared
    /// errors these are three standard deviations of what a perfect picture scores, for PSNR three times the floor's squared
    /// error; for equivalent sub-frames a third of the highest count that the truth can
    /// tell, because error falls at least as fast as the count rises.
    pub fn strictest_bound(self, floor: f64) -> f64 {
        match (self, self.ideal()) {
            (Metric::Image(ImageMetric::Psnr, _), _) => floor - 10.0 * 3f64.log10(),
            (_, Ideal::Lowest) => 3.0 * floor,
            (_, Ideal::Highest) => floor / 3.0,
            // Distance from the target.
            (_, Ideal::Target(_)) => 3.0 * floor,
        }
    }

    fn describe(self) -> (&'static str, &'static str, Ideal) {
        match self {
            Metric::Image(metric, _) => metric.describe(),
            Metric::Object(metric) => metric.describe(),
            Metric::LabelTotalVariation => ("label_tv", "", Ideal::Lowest),
            Metric::LabelTotalVariationP95 => ("label_tv_p95", "", Ideal::Lowest),
            Metric::OccluderContamination => ("occluder_contamination", "", Ideal::Lowest),
            Metric::StaticContamination => ("static_contamination", "white", Ideal::Lowest),
            Metric::Frozen(metric) => metric.describe(),
            Metric::Probe(metric) => metric.describe(),
            Metric::Skill(metric) => metric.describe(),
            Metric::EquivalentSubframes => ("n_eq", "sub-frames", Ideal::Highest),
            Metric::EquivalentSubframesFlip => ("n_eq_flip", "sub-frames", Ideal::Highest),
            Metric::EquivalentSubframesLabel => ("n_eq_label_tv", "sub-frames", Ideal::Highest),
        }
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
