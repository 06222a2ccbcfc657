//! All scores of one picture.

use serde::{Deserialize, Serialize};

use crate::equivalent::Equivalent;
use crate::{ImageMetric, Measured, Metric, ObjectMetric, Region, Score};

/// What one picture scores against one truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scores {
    /// Where anything moved.
    pub moving: ImageScores,
    /// Where nothing did.
    #[serde(rename = "static")]
    pub still: ImageScores,
    /// The whole picture.
    pub full: ImageScores,
    /// Which object the shutter's time was given to.
    pub label_total_variation: LabelScores,
    /// Every object but the background.
    pub objects: Vec<ObjectScores>,
    /// As good as the mean of how many sub-frames.
    pub equivalent_subframes: EquivalentScores,
}

/// Errors of colour over one region, at the viewing exposure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImageScores {
    /// Unbiased mean squared error; display white is 1. May be negative by noise.
    pub mse: Measured,
    /// Of `mse` against a peak of 1, in dB.
    pub psnr: Measured,
    /// Unbiased mean of squared error over squared truth.
    pub relmse: Measured,
    /// Mean LDR-FLIP.
    pub flip: Measured,
    /// LDR-FLIP that 95 % of the pixels do not exceed.
    pub flip_p95: Measured,
    /// Mean HDR-FLIP.
    pub flip_hdr: Measured,
}

/// Fraction of the shutter given to the wrong object, over the moving region.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LabelScores {
    /// Mean over pixels.
    pub mean: Measured,
    /// What 95 % of the pixels do not exceed.
    pub p95: Measured,
}

/// Scores of one object's matte.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ObjectScores {
    /// Its name.
    pub object: String,
    /// Whether any of it moves on screen.
    pub moves: bool,
    /// Mean displacement over the shutter, in pixels; +x right, +y down. Zero for what is not seen.
    pub displacement: [f64; 2],
    /// Bleed beside the support, in pixels.
    pub bleed_lateral: Measured,
    /// Bleed ahead of it, in pixels.
    pub bleed_leading: Measured,
    /// Bleed behind it, in pixels.
    pub bleed_trailing: Measured,
    /// Pixels that each lateral silhouette grew by.
    pub lateral_growth: Measured,
    /// Pixels that it shrank by.
    pub lateral_shrink: Measured,
    /// Distance of its mass from where it should lie along the motion, in pixels.
    pub misplacement: Measured,
    /// Signed shift along the motion, in pixels; positive = ahead.
    pub centroid: Measured,
    /// Length along the motion over the true length.
    pub extent: Measured,
    /// Mean of what is missing where the object covers the pixel throughout.
    pub hole: Measured,
    /// Missing mass over true mass.
    pub deficit: Measured,
    /// Mass over true mass.
    pub energy: Measured,
    /// Label total variation on the object, within the moving region.
    pub label_total_variation: Measured,
}

/// The headline: how many accumulated sub-frames have the same error over the moving region.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EquivalentScores {
    /// By unbiased squared error of colour.
    pub mse: Equivalent,
    /// By mean LDR-FLIP.
    pub flip: Equivalent,
    /// By mean label total variation.
    pub label_total_variation: Equivalent,
}

impl Scores {
    /// The score that a metric names. For a score per object, that of the worst among those that move (or, for occluder
    /// contamination, that stand still).
    pub fn get(&self, metric: Metric) -> Measured {
        match metric {
            Metric::Image(metric, region) => self.region(region).get(metric).clone(),
            Metric::LabelTotalVariation => self.label_total_variation.mean.clone(),
            Metric::LabelTotalVariationP95 => self.label_total_variation.p95.clone(),
            Metric::Object(object) => self.worst_of(metric, object, true),
            Metric::OccluderContamination => {
                self.worst_of(metric, ObjectMetric::LabelTotalVariation, false)
            }
            Metric::EquivalentSubframes => self.equivalent_subframes.mse.measured(),
            Metric::EquivalentSubframesFlip => self.equivalent_subframes.flip.measured(),
            Metric::EquivalentSubframesLabel => {
                self.equivalent_subframes.label_total_variation.measured()
            }
        }
    }

    /// The object whose score is worst, and that score: by name, for messages. None for metrics that are not per object.
    pub fn worst_object(&self, metric: Metric) -> Option<(&str, Score)> {
        let (object, moves) = match metric {
            Metric::Object(object) => (object, true),
            Metric::OccluderContamination => (ObjectMetric::LabelTotalVariation, false),
            _ => return None,
        };
        self.objects
            .iter()
            .filter(|scores| scores.moves == moves)
            .filter_map(|scores| match scores.get(object) {
                Measured::Score(score) => Some((scores.object.as_str(), *score)),
                Measured::NotApplicable { .. } => None,
            })
            .max_by(|(_, a), (_, b)| {
                let badness = |score: &Score| metric.ideal().badness(score.value);
                badness(a).total_cmp(&badness(b))
            })
    }

    fn region(&self, region: Region) -> &ImageScores {
        match region {
            Region::Moving => &self.moving,
            Region::Still => &self.still,
            Region::Full => &self.full,
        }
    }

    fn worst_of(&self, metric: Metric, object: ObjectMetric, moves: bool) -> Measured {
        if let Some((_, score)) = self.worst_object(metric) {
            return Measured::Score(score);
        }
        let reasons: Vec<String> = self
            .objects
            .iter()
            .filter(|scores| scores.moves == moves)
            .filter_map(|scores| match scores.get(object) {
                Measured::Score(_) => None,
                Measured::NotApplicable { reason } => Some(format!("{}: {reason}", scores.object)),
            })
            .collect();
        if reasons.is_empty() {
            Measured::not_applicable(if moves {
                "no object moves on screen"
            } else {
                "no object but the background stands still"
            })
        } else {
            Measured::not_applicable(reasons.join("; "))
        }
    }
}

impl ImageScores {
    /// The score that a metric names.
    pub fn get(&self, metric: ImageMetric) -> &Measured {
        match metric {
            ImageMetric::Mse => &self.mse,
            ImageMetric::Psnr => &self.psnr,
            ImageMetric::Relmse => &self.relmse,
            ImageMetric::Flip => &self.flip,
            ImageMetric::FlipP95 => &self.flip_p95,
            ImageMetric::FlipHdr => &self.flip_hdr,
        }
    }
}

impl ObjectScores {
    /// The score that a metric names.
    pub fn get(&self, metric: ObjectMetric) -> &Measured {
        match metric {
            ObjectMetric::BleedLateral => &self.bleed_lateral,
            ObjectMetric::BleedLeading => &self.bleed_leading,
            ObjectMetric::BleedTrailing => &self.bleed_trailing,
            ObjectMetric::LateralGrowth => &self.lateral_growth,
            ObjectMetric::LateralShrink => &self.lateral_shrink,
            ObjectMetric::Misplacement => &self.misplacement,
            ObjectMetric::Centroid => &self.centroid,
            ObjectMetric::Extent => &self.extent,
            ObjectMetric::Hole => &self.hole,
            ObjectMetric::Deficit => &self.deficit,
            ObjectMetric::Energy => &self.energy,
            ObjectMetric::LabelTotalVariation => &self.label_total_variation,
        }
    }
}
