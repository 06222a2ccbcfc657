//! The pictures that the scores were pooled from.

use frame::{Image, Plane};

/// One error map per kind of score, each of the output's size.
#[derive(Clone, Debug, PartialEq)]
pub struct Maps {
    /// Output minus the truth's mean: radiance, signed. For looking at; the squared error comes from the halves.
    pub signed_error: Image,
    /// `(F - A)(F - B)` at the viewing exposure, mean over the channels; MSE and PSNR are pooled from it.
    pub squared_error: Plane,
    /// The same over the squared truth; relMSE is pooled from it.
    pub relative_squared_error: Plane,
    /// `|F - T|` at the viewing exposure, mean over the channels; MAE is pooled from it.
    pub absolute_error: Plane,
    /// The same over the mean of both values, in [0, 2]; SMAPE is pooled from it.
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
    /// As `squared_error`, against the truth whose shading stands still at the instant.
    pub frozen_squared_error: Plane,
    /// `|F - I|` at the viewing exposure, mean over the channels, I being the instant; 0 where anything moves.
    pub static_change: Plane,
}
