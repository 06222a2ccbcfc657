//! Rows of all metrics, group by group, and the structs of their scores.
//!
//! To add one, write its row here and measure it where the struct of its group is made; the crate's
//! `README.md` defines it.

use serde::{Deserialize, Serialize};

use super::row::{Group, Row, metrics};
use crate::subframes::Equivalent;
use crate::{ErrorMap, Ideal, Measured};

/// Reason why no bound may name a skill.
const GHOSTS_HAVE_SKILL: &str =
    "a grey ghost over everything has skill; bound the error itself, or n_eq";

metrics! {
    /// An error of colour.
    enum ImageMetric;
    /// Errors of colour over one region, at the viewing exposure.
    struct ImageScores of Measured {}

    /// Unbiased mean squared error; display white is 1. May be negative by noise.
    Mse => mse {
        name: "mse", unit: "white^2", ideal: Ideal::Lowest, group: Group::RunJson, map: ErrorMap::SquaredError,
        meaning: "squared error of colour",
    }

    /// Peak signal to noise ratio from `mse` and a peak of 1, in dB.
    Psnr => psnr {
        name: "psnr", unit: "dB", ideal: Ideal::Highest, group: Group::Seen, map: ErrorMap::SquaredError,
        meaning: "signal to noise ratio of colour",
    }

    /// Unbiased mean of squared error over squared truth.
    Relmse => relmse {
        name: "relmse", unit: "", ideal: Ideal::Lowest, group: Group::RunJson, map: ErrorMap::RelativeSquaredError,
        meaning: "squared error of colour relative to the truth",
    }

    /// Mean absolute error; display white is 1.
    Mae => mae {
        name: "mae", unit: "white", ideal: Ideal::Lowest, group: Group::RunJson, map: ErrorMap::AbsoluteError,
        meaning: "absolute error of colour",
    }

    /// Mean of the error's size over the mean of both values, in [0, 2].
    Smape => smape {
        name: "smape", unit: "", ideal: Ideal::Lowest, group: Group::RunJson, map: ErrorMap::SymmetricError,
        meaning: "absolute error of colour relative to both pictures",
    }

    /// Mean LDR-FLIP.
    Flip => flip {
        name: "flip", unit: "", ideal: Ideal::Lowest, group: Group::Seen, map: ErrorMap::Flip,
        meaning: "visible difference",
    }

    /// Value of LDR-FLIP up to which pixels make up half of its sum.
    FlipWeightedMedian => flip_weighted_median {
        name: "flip_weighted_median", unit: "", ideal: Ideal::Lowest, group: Group::RunJson, map: ErrorMap::Flip,
        meaning: "half of all visible difference is in pixels up to this value",
        is_percentile: true,
    }

    /// Value of LDR-FLIP that 95 % of the pixels do not exceed.
    FlipP95 => flip_p95 {
        name: "flip_p95", unit: "", ideal: Ideal::Lowest, group: Group::Seen, map: ErrorMap::Flip,
        meaning: "visible difference that 19 of 20 pixels do not exceed",
        is_percentile: true,
    }

    /// Value of LDR-FLIP that 99 % of the pixels do not exceed.
    FlipP99 => flip_p99 {
        name: "flip_p99", unit: "", ideal: Ideal::Lowest, group: Group::RunJson, map: ErrorMap::Flip,
        meaning: "visible difference that 99 of 100 pixels do not exceed",
        is_percentile: true,
    }

    /// Mean HDR-FLIP.
    FlipHdr => flip_hdr {
        name: "flip_hdr", unit: "", ideal: Ideal::Lowest, group: Group::Seen, map: ErrorMap::FlipHdr,
        meaning: "visible difference at the exposure that shows most of it",
    }

    /// Mean structural similarity of display values.
    Ssim => ssim {
        name: "ssim", unit: "", ideal: Ideal::Highest, group: Group::Seen, map: ErrorMap::Flip,
        meaning: "structural similarity",
        report_only: Some(
            "punishes unbiased noise more than a shift by three pixels; bound flip instead",
        ),
    }

    /// Root mean square of noise and patterns of pixel size, relative to the truth's brightness.
    Grain => grain {
        name: "grain", unit: "brightness", ideal: Ideal::Lowest, group: Group::RunJson, map: ErrorMap::SquaredError,
        meaning: "noise and patterns of pixel size",
    }
}

metrics! {
    /// Label total variation.
    enum LabelMetric;
    /// Fraction of the shutter given to the wrong object, over the moving region.
    struct LabelScores of Measured {}

    /// Mean over pixels.
    Mean => mean {
        name: "label_tv", unit: "", ideal: Ideal::Lowest, group: Group::Label, map: ErrorMap::LabelTotalVariation,
        meaning: "share of the shutter given to the wrong object",
    }

    /// 95th percentile over pixels.
    P95 => p95 {
        name: "label_tv_p95", unit: "", ideal: Ideal::Lowest, group: Group::Label, map: ErrorMap::LabelTotalVariation,
        meaning: "share of the shutter given to the wrong object that 19 of 20 moving pixels do not exceed",
        is_percentile: true,
    }
}

metrics! {
    /// A score of one object's matte.
    enum ObjectMetric;
    /// Scores of one object's matte.
    struct ObjectScores of Measured {
        /// Its name.
        object: String,
        /// True if any of it moves on screen.
        moves: bool,
        /// Mean displacement over the shutter, in pixels; +x right, +y down. Zero for an object
        /// that is not seen.
        displacement: [f64; 2],
    }

    /// Bleed to the sides of the support, in pixels.
    BleedLateral => bleed_lateral {
        name: "bleed_lateral", unit: "px", ideal: Ideal::Lowest, group: Group::Silhouette, map: ErrorMap::Bleed,
        meaning: "mover spilled to the sides of its path",
    }

    /// Bleed ahead of it, in pixels.
    BleedLeading => bleed_leading {
        name: "bleed_leading", unit: "px", ideal: Ideal::Lowest, group: Group::Silhouette, map: ErrorMap::Bleed,
        meaning: "mover spilled ahead of its path",
    }

    /// Bleed behind it, in pixels.
    BleedTrailing => bleed_trailing {
        name: "bleed_trailing", unit: "px", ideal: Ideal::Lowest, group: Group::Silhouette, map: ErrorMap::Bleed,
        meaning: "mover spilled behind its path",
    }

    /// Pixels that each lateral silhouette grew by.
    LateralGrowth => lateral_growth {
        name: "lateral_growth", unit: "px", ideal: Ideal::Lowest, group: Group::Silhouette, map: ErrorMap::LabelTotalVariation,
        meaning: "how far the silhouette grew sideways",
    }

    /// Mass that rows along the motion gained within the silhouette, in pixels of lateral
    /// silhouette.
    RowGain => row_gain {
        name: "row_gain", unit: "px", ideal: Ideal::Lowest, group: Group::Silhouette, map: ErrorMap::LabelTotalVariation,
        meaning: "how much more of the mover its own rows hold, as pixels of silhouette",
    }

    /// Mass that they lost, in pixels of lateral silhouette.
    RowLoss => row_loss {
        name: "row_loss", unit: "px", ideal: Ideal::Lowest, group: Group::Silhouette, map: ErrorMap::LabelTotalVariation,
        meaning: "how much less of the mover rows along the motion hold, as pixels of silhouette",
    }

    /// Distance of its mass from where it should be along the motion, in pixels.
    Misplacement => misplacement {
        name: "misplacement", unit: "px", ideal: Ideal::Lowest, group: Group::Silhouette, map: ErrorMap::LabelTotalVariation,
        meaning: "how far the smear's mass is displaced along the motion",
    }

    /// Signed shift of the centre of mass along the motion, in pixels; positive = ahead.
    Centroid => centroid {
        name: "centroid", unit: "px", ideal: Ideal::Target(0.0), group: Group::Silhouette, map: ErrorMap::LabelTotalVariation,
        meaning: "how far the smear's centre of mass is ahead; 0 is right",
    }

    /// Length along the motion over the true length.
    Extent => extent {
        name: "extent", unit: "", ideal: Ideal::Target(1.0), group: Group::Silhouette, map: ErrorMap::LabelTotalVariation,
        meaning: "length of the smear over the true length; 1 is right",
    }

    /// Total variation along the motion over the true one, minus 1: steps, ripples and noise raise
    /// it.
    TvExcess => tv_excess {
        name: "tv_excess", unit: "", ideal: Ideal::Target(0.0), group: Group::Silhouette, map: ErrorMap::LabelTotalVariation,
        meaning: "steps, ripples and grain along the smear; 0 is right",
    }

    /// Mean missing coverage where only the object is seen while the shutter is open.
    Hole => hole {
        name: "hole", unit: "", ideal: Ideal::Target(0.0), group: Group::Silhouette, map: ErrorMap::LabelTotalVariation,
        meaning: "how much shows through where the mover hides all; 0 is right",
    }

    /// Missing mass over true mass.
    Deficit => deficit {
        name: "deficit", unit: "", ideal: Ideal::Lowest, group: Group::Silhouette, map: ErrorMap::LabelTotalVariation,
        meaning: "part of the mover's mass that is missing where it should be",
    }

    /// Mass over true mass.
    Energy => energy {
        name: "energy", unit: "", ideal: Ideal::Target(1.0), group: Group::Silhouette, map: ErrorMap::LabelTotalVariation,
        meaning: "mass of the mover over its true mass; 1 is right",
    }

    /// Label total variation on the object, within the moving region.
    LabelTotalVariation => label_total_variation {
        name: "object_label_tv", unit: "", ideal: Ideal::Lowest, group: Group::RunJson, map: ErrorMap::LabelTotalVariation,
        meaning: "share of the mover's time given to something else",
    }

    /// Mean LDR-FLIP on the object, within the moving region.
    Flip => flip {
        name: "object_flip", unit: "", ideal: Ideal::Lowest, group: Group::Silhouette, map: ErrorMap::Flip,
        meaning: "visible difference on the mover",
    }

    /// Mean squared difference of the matte's gradient magnitudes, within the moving region.
    GradientError => gradient_error {
        name: "gradient_error", unit: "1/px^2", ideal: Ideal::Lowest, group: Group::RunJson, map: ErrorMap::GradientError,
        meaning: "edges of the mover's matte that are too sharp or too soft",
    }
}

metrics! {
    /// An error against the frozen-shading truth, over the moving region.
    enum FrozenMetric;
    /// Errors over the moving region against the truth with shading frozen at the instant: errors
    /// of visibility alone.
    struct FrozenScores of Measured {}

    /// Unbiased mean squared error; display white is 1.
    Mse => mse {
        name: "mse_frozen", unit: "white^2", ideal: Ideal::Lowest, group: Group::RunJson, map: ErrorMap::FrozenSquaredError,
        meaning: "squared error without shadows, lights and reflections that move",
    }

    /// Mean LDR-FLIP.
    Flip => flip {
        name: "flip_frozen", unit: "", ideal: Ideal::Lowest, group: Group::Instant, map: ErrorMap::Flip,
        meaning: "visible difference without shadows, lights and reflections that move",
    }

    /// Unbiased mean squared difference of the two truths: shadows, lights and reflections that
    /// move.
    Shading => shading {
        name: "mse_shading", unit: "white^2", ideal: Ideal::Lowest, group: Group::Instant, map: ErrorMap::Flip,
        meaning: "what shadows, lights and reflections that move cost any filter of one frame",
        report_only: Some(
            "is a property of the scene, whatever the filter does",
        ),
    }
}

metrics! {
    /// A score of probes, which are pictures of ones and of coordinates.
    enum ProbeMetric;
    /// Scores of a filter's output for probes, which have an exact truth.
    struct ProbeScores of Measured {}

    /// Largest difference of a pixel's sum of weights from 1.
    Unity => unity {
        name: "unity", unit: "", ideal: Ideal::Lowest, group: Group::Gathered, map: ErrorMap::Unity,
        meaning: "how far the weights of any pixel are from adding up to 1",
    }

    /// Mean distance between the centres of the gathered and the true origins at the instant, in
    /// pixels, over the knowable region.
    GatherOffset => gather_offset {
        name: "gather_offset", unit: "px", ideal: Ideal::Lowest, group: Group::Gathered, map: ErrorMap::GatherOffset,
        meaning: "how far from the right place the filter gathers",
    }

    /// Mean difference of the standard deviations about these centres, in pixels, over the knowable
    /// region.
    GatherSpread => gather_spread {
        name: "gather_spread", unit: "px", ideal: Ideal::Lowest, group: Group::Gathered, map: ErrorMap::GatherSpread,
        meaning: "how much too widely or too narrowly it gathers",
    }
}

metrics! {
    /// Share of the way from no blur to the one-frame oracle, over the moving region.
    enum SkillMetric;
    /// Share of the way from no blur to the one-frame oracle, by errors over the moving region: 0
    /// is as good as a sharp picture of the shutter's middle, 1 as good as the oracle; below 0 is
    /// worse than no blur.
    struct SkillScores of Measured {}

    /// By unbiased squared error of colour.
    Mse => mse {
        name: "skill_mse", unit: "", ideal: Ideal::Highest, group: Group::Proportion, map: ErrorMap::SquaredError,
        meaning: "share of the way from a sharp picture of the shutter's middle, 0, to the one-frame oracle, 1, by squared error",
        report_only: Some(GHOSTS_HAVE_SKILL),
    }

    /// By mean LDR-FLIP.
    Flip => flip {
        name: "skill_flip", unit: "", ideal: Ideal::Highest, group: Group::Proportion, map: ErrorMap::Flip,
        meaning: "share of the way from a sharp picture of the shutter's middle, 0, to the one-frame oracle, 1, by visible difference",
        report_only: Some(GHOSTS_HAVE_SKILL),
    }

    /// By mean label total variation.
    LabelTotalVariation => label_total_variation {
        name: "skill_label_tv", unit: "", ideal: Ideal::Highest, group: Group::Proportion, map: ErrorMap::LabelTotalVariation,
        meaning: "share of the way from a sharp picture of the shutter's middle, 0, to the one-frame oracle, 1, by share given to the wrong object",
        report_only: Some(GHOSTS_HAVE_SKILL),
    }
}

metrics! {
    /// Sub-frames that an accumulation needs for the same error over the moving region.
    enum EquivalentMetric;
    /// Number of accumulated sub-frames with the same error over the moving region: the headline.
    struct EquivalentScores of Equivalent {}

    /// By unbiased squared error of colour.
    Mse => mse {
        name: "n_eq", unit: "sub-frames", ideal: Ideal::Highest, group: Group::Proportion, map: ErrorMap::SquaredError,
        meaning: "as good as averaging that many sub-frames, by squared error",
    }

    /// By mean LDR-FLIP.
    Flip => flip {
        name: "n_eq_flip", unit: "sub-frames", ideal: Ideal::Highest, group: Group::Proportion, map: ErrorMap::Flip,
        meaning: "as good as averaging that many sub-frames, by visible difference",
    }

    /// By mean label total variation.
    LabelTotalVariation => label_total_variation {
        name: "n_eq_label_tv", unit: "sub-frames", ideal: Ideal::Highest, group: Group::Proportion, map: ErrorMap::LabelTotalVariation,
        meaning: "as good as averaging that many sub-frames, by share given to the wrong object",
    }
}
