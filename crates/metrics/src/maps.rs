//! Error maps that scores are pooled from, and their names.

use frame::{Image, Plane};

/// One error map per kind of score, each of the output's size.
#[derive(Clone, Debug, PartialEq)]
pub struct Maps {
    /// Output minus the truth's mean: radiance, signed. It is for looking at; the squared error comes from the halves.
    pub signed_error: Image,
    /// `(F - A)(F - B)` at the viewing exposure, mean over the channels; MSE and PSNR are pooled from it.
    pub squared_error: Plane,
    /// `squared_error` over the squared truth; relMSE is pooled from it.
    pub relative_squared_error: Plane,
    /// `|F - T|` at the viewing exposure, mean over the channels; MAE is pooled from it.
    pub absolute_error: Plane,
    /// `absolute_error` over the mean of both values, in [0, 2]; SMAPE is pooled from it.
    pub symmetric_error: Plane,
    /// Structural similarity of what a display shows, mean over the channels, in [-1, 1].
    pub ssim: Plane,
    /// LDR-FLIP, in [0, 1].
    pub flip: Plane,
    /// HDR-FLIP, in [0, 1].
    pub flip_hdr: Plane,
    /// Fraction of the shutter given to the wrong object, in [0, 1].
    pub label_total_variation: Plane,
    /// Sum over moving objects of their matte where the truth never shows them.
    pub bleed: Plane,
    /// Sum over moving objects of the squared difference of their mattes' gradient magnitudes, per square pixel.
    pub gradient_error: Plane,
    /// `squared_error` against the truth whose shading is frozen at the instant.
    pub frozen_squared_error: Plane,
    /// `|F - I|` at the viewing exposure, mean over the channels, I being the instant; 0 where anything moves.
    pub static_change: Plane,
}

/// Name of an error map, of the output or of probes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorMap {
    /// [`Maps::squared_error`].
    SquaredError,
    /// [`Maps::relative_squared_error`].
    RelativeSquaredError,
    /// [`Maps::absolute_error`].
    AbsoluteError,
    /// [`Maps::symmetric_error`].
    SymmetricError,
    /// [`Maps::ssim`].
    Ssim,
    /// [`Maps::flip`].
    Flip,
    /// [`Maps::flip_hdr`].
    FlipHdr,
    /// [`Maps::label_total_variation`].
    LabelTotalVariation,
    /// [`Maps::bleed`].
    Bleed,
    /// [`Maps::gradient_error`].
    GradientError,
    /// [`Maps::frozen_squared_error`].
    FrozenSquaredError,
    /// [`Maps::static_change`].
    StaticChange,
    /// [`ProbeMaps::unity`](crate::ProbeMaps::unity).
    Unity,
    /// [`ProbeMaps::offset`](crate::ProbeMaps::offset).
    GatherOffset,
    /// [`ProbeMaps::spread`](crate::ProbeMaps::spread).
    GatherSpread,
}

impl ErrorMap {
    /// Every map, in the order of a file.
    pub const ALL: [ErrorMap; 15] = [
        ErrorMap::SquaredError,
        ErrorMap::RelativeSquaredError,
        ErrorMap::AbsoluteError,
        ErrorMap::SymmetricError,
        ErrorMap::Ssim,
        ErrorMap::Flip,
        ErrorMap::FlipHdr,
        ErrorMap::LabelTotalVariation,
        ErrorMap::Bleed,
        ErrorMap::GradientError,
        ErrorMap::FrozenSquaredError,
        ErrorMap::StaticChange,
        ErrorMap::Unity,
        ErrorMap::GatherOffset,
        ErrorMap::GatherSpread,
    ];

    /// Returns the name of its channel in errors.exr.
    pub fn name(self) -> &'static str {
        match self {
            ErrorMap::SquaredError => "squared_error",
            ErrorMap::RelativeSquaredError => "relative_squared_error",
            ErrorMap::AbsoluteError => "absolute_error",
            ErrorMap::SymmetricError => "symmetric_error",
            ErrorMap::Ssim => "ssim",
            ErrorMap::Flip => "flip",
            ErrorMap::FlipHdr => "flip_hdr",
            ErrorMap::LabelTotalVariation => "label_tv",
            ErrorMap::Bleed => "bleed",
            ErrorMap::GradientError => "gradient_error",
            ErrorMap::FrozenSquaredError => "frozen_squared_error",
            ErrorMap::StaticChange => "static_change",
            ErrorMap::Unity => "unity",
            ErrorMap::GatherOffset => "gather_offset",
            ErrorMap::GatherSpread => "gather_spread",
        }
    }
}
