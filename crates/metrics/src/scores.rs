//! All scores of one picture.

use serde::{Deserialize, Serialize};

use crate::equivalent::Equivalent;
use crate::{
    FrozenMetric, ImageMetric, Measured, Metric, ObjectMetric, ProbeMetric, Region, Score,
    SkillMetric,
};

/// What one picture scores against one truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scores {
    /// Where anything moved.
    pub moving: ImageScores,
    /// The same without the band that a bleed would reach.
    pub support: ImageScores,
    /// Where nothing did.
    #[serde(rename = "static")]
    pub still: ImageScores,
    /// The whole picture.
    pub full: ImageScores,
    /// Where the frame of the instant shows all that the shutter sees.
    pub knowable: ImageScores,
    /// Where it does not.
    pub unknowable: ImageScores,
    /// Against the truth whose shading stands still.
    pub frozen: FrozenScores,
    /// Mean absolute change of the instant's colour where nothing moves, in display-scaled radiance.
    pub static_contamination: Measured,
    /// Which object the shutter's time was given to.
    pub label_total_variation: LabelScores,
    /// Every object but the background.
    pub objects: Vec<ObjectScores>,
    /// What the filter makes of pictures of ones and of coordinates.
    pub probes: ProbeScores,
    /// Share of the way from doing nothing to the one-frame oracle.
    pub skill: SkillScores,
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
    /// Mean absolute error; display white is 1.
    pub mae: Measured,
    /// Mean of the error's size over the mean of both values, in [0, 2].
    pub smape: Measured,
    /// Mean LDR-FLIP.
    pub flip: Measured,
    /// LDR-FLIP up to which half of its sum lies.
    pub flip_weighted_median: Measured,
    /// LDR-FLIP that 95 % of the pixels do not exceed.
    pub flip_p95: Measured,
    /// LDR-FLIP that 99 % of the pixels do not exceed.
    pub flip_p99: Measured,
    /// Mean HDR-FLIP.
    pub flip_hdr: Measured,
    /// Mean structural similarity of what a display shows.
    pub ssim: Measured,
}

/// Errors over the moving region against the truth whose shading stands still at the instant: what is left is visibility.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrozenScores {
    /// Unbiased mean squared error; display white is 1.
    pub mse: Measured,
    /// Mean LDR-FLIP.
    pub flip: Measured,
    /// Unbiased mean squared difference of the two truths: shadows, lights and reflections that move.
    pub shading: Measured,
}

/// What a filter makes of pictures of ones and of coordinates, whose truth is exact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProbeScores {
    /// Largest difference of a pixel's sum of weights from 1.
    pub unity: Measured,
    /// Mean distance between the middle of what the filter gathers and the middle of where that was at the instant, in
    /// pixels, over the knowable region.
    pub gather_offset: Measured,
    /// Mean difference of the standard deviations about these middles, in pixels, over the knowable region.
    pub gather_spread: Measured,
}

/// Share of the way from doing nothing to the one-frame oracle, by errors over the moving region: 0 is as good as doing
/// nothing, 1 as good as the oracle; below 0 is worse than doing nothing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SkillScores {
    /// By unbiased squared error of colour.
    pub mse: Measured,
    /// By mean LDR-FLIP.
    pub flip: Measured,
    /// By mean label total variation.
    pub label_total_variation: Measured,
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
    /// Mass that rows along the motion gained within the silhouette, in pixels of lateral silhouette.
    pub row_gain: Measured,
    /// Mass that they lost, likewise.
    pub row_loss: Measured,
    /// Distance of its mass from where it should lie along the motion, in pixels.
    pub misplacement: Measured,
    /// Signed shift of the centre of mass along the motion, in pixels; positive = ahead.
    pub centroid: Measured,
    /// Length along the motion over the true length.
    pub extent: Measured,
    /// Total variation along the motion over the true one, less 1: steps, ripples and noise raise it.
    pub tv_excess: Measured,
    /// Mean of what is missing where nothing but the object is seen while the shutter is open.
    pub hole: Measured,
    /// Missing mass over true mass.
    pub deficit: Measured,
    /// Mass over true mass.
    pub energy: Measured,
    /// Label total variation on the object, within the moving region.
    pub label_total_variation: Measured,
    /// Mean squared difference of the matte's gradient magnitudes, within the moving region.
    pub gradient_error: Measured,
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
            Metric::StaticContamination => self.static_contamination.clone(),
            Metric::Frozen(metric) => self.frozen.get(metric).clone(),
            Metric::Probe(metric) => self.probes.get(metric).clone(),
            Metric::Skill(metric) => self.skill.get(metric).clone(),
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

    /// The largest of the three bleeds of the worst moving objects, and which one it is; none where none applies. Where two are
    /// equal, lateral comes before leading and trailing.
    pub fn largest_bleed(&self) -> Option<(ObjectMetric, Score)> {
        let bleeds = ObjectMetric::BLEEDS.into_iter();
        let found = bleeds.filter_map(|bleed| {
            let (_, score) = self.worst_object(Metric::Object(bleed))?;
            Some((bleed, score))
        });
        found.reduce(|largest, other| match other.1.value > largest.1.value {
            true => other,
            false => largest,
        })
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

    /// Replaces every score that mattes take part in by a reason why it means nothing.
    pub fn take_out_mattes(&mut self, reason: &str) {
        let none = || Measured::not_applicable(reason);
        self.label_total_variation = LabelScores {
            mean: none(),
            p95: none(),
        };
        self.skill.label_total_variation = none();
        self.equivalent_subframes.label_total_variation = Equivalent::refused(reason);
        for scores in &mut self.objects {
            *scores = ObjectScores {
                object: scores.object.clone(),
                moves: scores.moves,
                displacement: scores.displacement,
                bleed_lateral: none(),
                bleed_leading: none(),
                bleed_trailing: none(),
                lateral_growth: none(),
                row_gain: none(),
                row_loss: none(),
                misplacement: none(),
                centroid: none(),
                extent: none(),
                tv_excess: none(),
                hole: none(),
                deficit: none(),
                energy: none(),
                label_total_variation: none(),
                gradient_error: none(),
            };
        }
    }

    fn region(&self, region: Region) -> &ImageScores {
        match region {
            Region::Moving => &self.moving,
            Region::Support => &self.support,
            Region::Still => &self.still,
            Region::Full => &self.full,
            Region::Knowable => &self.knowable,
            Region::Unknowable => &self.unknowable,
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
            ImageMetric::Mae => &self.mae,
            ImageMetric::Smape => &self.smape,
            ImageMetric::Flip => &self.flip,
            ImageMetric::FlipWeightedMedian => &self.flip_weighted_median,
            ImageMetric::FlipP95 => &self.flip_p95,
            ImageMetric::FlipP99 => &self.flip_p99,
            ImageMetric::FlipHdr => &self.flip_hdr,
            ImageMetric::Ssim => &self.ssim,
        }
    }
}

impl FrozenScores {
    /// The score that a metric names.
    pub fn get(&self, metric: FrozenMetric) -> &Measured {
        match metric {
            FrozenMetric::Mse => &self.mse,
            FrozenMetric::Flip => &self.flip,
            FrozenMetric::Shading => &self.shading,
        }
    }
}

impl ProbeScores {
    /// The score that a metric names.
    pub fn get(&self, metric: ProbeMetric) -> &Measured {
        match metric {
            ProbeMetric::Unity => &self.unity,
            ProbeMetric::GatherOffset => &self.gather_offset,
            ProbeMetric::GatherSpread => &self.gather_spread,
        }
    }

    /// No probe score, because of `reason`.
    pub fn not_applicable(reason: &str) -> Self {
        let none = || Measured::not_applicable(reason);
        Self {
            unity: none(),
            gather_offset: none(),
            gather_spread: none(),
        }
    }
}

impl SkillScores {
    /// The score that a metric names.
    pub fn get(&self, metric: SkillMetric) -> &Measured {
        match metric {
            SkillMetric::Mse => &self.mse,
            SkillMetric::Flip => &self.flip,
            SkillMetric::LabelTotalVariation => &self.label_total_variation,
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
            ObjectMetric::RowGain => &self.row_gain,
            ObjectMetric::RowLoss => &self.row_loss,
            ObjectMetric::Misplacement => &self.misplacement,
            ObjectMetric::Centroid => &self.centroid,
            ObjectMetric::Extent => &self.extent,
            ObjectMetric::TvExcess => &self.tv_excess,
            ObjectMetric::Hole => &self.hole,
            ObjectMetric::Deficit => &self.deficit,
            ObjectMetric::Energy => &self.energy,
            ObjectMetric::LabelTotalVariation => &self.label_total_variation,
            ObjectMetric::GradientError => &self.gradient_error,
        }
    }
}
