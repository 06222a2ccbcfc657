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
    /// LDR-FLIP, in [0, 1].
    pub flip: Plane,
    /// HDR-FLIP, in [0, 1].
    pub flip_hdr: Plane,
    /// Fraction of the shutter given to the wrong object, in [0, 1].
    pub label_total_variation: Plane,
    /// Sum over moving objects of their matte where the truth never shows them.
    pub bleed: Plane,
}
