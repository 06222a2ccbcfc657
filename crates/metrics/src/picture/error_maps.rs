//! Error maps of a picture, before any pooling.

use frame::{Image, Picture, Plane, Raster};

use crate::color::absolute_error::{absolute_error, symmetric_error};
use crate::color::cross_error::{relative_squared_error, squared_error};
use crate::color::flip::{flip_hdr, flip_ldr};
use crate::color::ssim::ssim;
use crate::label::total_variation::label_variation;
use crate::math::conversion::{narrow, widen};
use crate::{Maps, Viewing};

/// Error maps of one picture, in `f64`: thousands of signed products are summed.
pub struct ErrorMaps {
    /// `(F - A)(F - B)`.
    pub squared: Raster<f64>,
    /// `squared` over the squared truth.
    pub relative: Raster<f64>,
    /// `|F - T|`.
    pub absolute: Raster<f64>,
    /// `absolute` over the mean of both.
    pub symmetric: Raster<f64>,
    /// Structural similarity.
    pub ssim: Raster<f64>,
    /// LDR-FLIP.
    pub flip: Raster<f64>,
    /// HDR-FLIP.
    pub flip_hdr: Raster<f64>,
    /// Label total variation.
    pub label: Raster<f64>,
}

impl ErrorMaps {
    /// Maps the errors of `output` against the truth's mean; squared errors by `halves`. `ended` hears of the end of each part.
    pub fn new(
        output: &Picture,
        halves: [&Image; 2],
        mean: &Picture,
        viewing: &Viewing,
        ended: fn(&'static str),
    ) -> Self {
        let scale = viewing.scale();
        let flip = widen(&flip_ldr(&mean.color, &output.color, viewing));
        ended("FLIP");
        let flip_hdr = widen(&flip_hdr(&mean.color, &output.color, viewing));
        ended("HDR-FLIP");
        let ssim = ssim(&output.color, &mean.color, viewing);
        ended("SSIM");
        let maps = Self {
            squared: squared_error(&output.color, halves, scale),
            relative: relative_squared_error(&output.color, halves, &mean.color, scale),
            absolute: absolute_error(&output.color, &mean.color, scale),
            symmetric: symmetric_error(&output.color, &mean.color, scale),
            ssim,
            flip,
            flip_hdr,
            label: label_variation(&output.coverage, &mean.coverage),
        };
        ended("other maps");
        maps
    }

    /// Converts the maps to planes, and adds more.
    pub fn to_maps(&self, output: &Picture, mean: &Picture, more: MoreMaps) -> Maps {
        Maps {
            signed_error: output.color.zip(&mean.color, |output, truth| {
                std::array::from_fn(|c| output[c] - truth[c])
            }),
            squared_error: narrow(&self.squared),
            relative_squared_error: narrow(&self.relative),
            absolute_error: narrow(&self.absolute),
            symmetric_error: narrow(&self.symmetric),
            ssim: narrow(&self.ssim),
            flip: narrow(&self.flip),
            flip_hdr: narrow(&self.flip_hdr),
            label_total_variation: narrow(&self.label),
            bleed: more.bleed,
            gradient_error: more.gradient_error,
            frozen_squared_error: narrow(&more.frozen_squared),
            static_change: narrow(&more.static_change),
        }
    }
}

/// Maps that are not errors of the whole picture's colour or labels.
pub struct MoreMaps {
    /// Sum over moving objects of their matte where the truth never shows them.
    pub bleed: Plane,
    /// Sum over moving objects of the errors of their gradient.
    pub gradient_error: Plane,
    /// `(F - A)(F - B)` for the truth whose shading stands still.
    pub frozen_squared: Raster<f64>,
    /// Change of the instant's colour where nothing moves.
    pub static_change: Raster<f64>,
}
