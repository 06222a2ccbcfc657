//! Errors per pixel, before any pooling.

use frame::{Image, Picture, Plane, Raster};

use crate::cross_error::{relative_squared_error, squared_error};
use crate::flip::{flip_hdr, flip_ldr};
use crate::label::total_variation;
use crate::{Maps, Viewing};

/// One picture's errors. In f64 where halves are multiplied: sums of thousands of signed products follow.
pub struct ErrorMaps {
    /// `(F - A)(F - B)`.
    pub squared: Raster<f64>,
    /// The same over the squared truth.
    pub relative: Raster<f64>,
    /// LDR-FLIP.
    pub flip: Raster<f64>,
    /// HDR-FLIP.
    pub flip_hdr: Raster<f64>,
    /// Label total variation.
    pub label: Raster<f64>,
}

impl ErrorMaps {
    /// Errors of `output` against the truth's mean; squared errors by `halves`.
    pub fn new(output: &Picture, halves: [&Image; 2], mean: &Picture, viewing: &Viewing) -> Self {
        let ((flip, flip_hdr), (squared, relative)) = rayon::join(
            || {
                rayon::join(
                    || widen(&flip_ldr(&mean.color, &output.color, viewing)),
                    || widen(&flip_hdr(&mean.color, &output.color, viewing)),
                )
            },
            || {
                let scale = viewing.scale();
                (
                    squared_error(&output.color, halves, scale),
                    relative_squared_error(&output.color, halves, &mean.color, scale),
                )
            },
        );
        Self {
            squared,
            relative,
            flip,
            flip_hdr,
            label: total_variation(&output.coverage, &mean.coverage),
        }
    }

    /// The same as pictures, with what else is worth looking at.
    pub fn maps(&self, output: &Picture, mean: &Picture, bleed: Plane) -> Maps {
        Maps {
            signed_error: output.color.zip(&mean.color, |output, truth| {
                std::array::from_fn(|c| output[c] - truth[c])
            }),
            squared_error: narrow(&self.squared),
            relative_squared_error: narrow(&self.relative),
            flip: narrow(&self.flip),
            flip_hdr: narrow(&self.flip_hdr),
            label_total_variation: narrow(&self.label),
            bleed,
        }
    }
}

/// A plane in f64, to be summed.
pub fn widen(plane: &Plane) -> Raster<f64> {
    plane.map(|value| f64::from(*value))
}

fn narrow(map: &Raster<f64>) -> Plane {
    map.map(|value| *value as f32)
}
