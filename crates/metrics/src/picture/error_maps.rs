//! Error maps of a picture, before any pooling.

use frame::{Image, Picture, Plane, Raster};

use crate::Maps;
use crate::color::absolute_error::{absolute, symmetric};
use crate::color::cross_error::{relative_squared, squared};
use crate::color::flip::Displayed;
use crate::color::grain::PixelGrain;
use crate::color::ssim::map_ssim;
use crate::label::label_variation;
use crate::math::raster::{index_pixels, map_pixels, zip_pixels};
use crate::picture::seen_truth::SeenTruth;

/// Error maps of one picture, in 64 bits where thousands of signed products or errors are summed.
pub struct ErrorMaps {
    /// Errors that a pixel has by itself.
    pub pixels: Raster<PixelErrors>,
    /// Structural similarity.
    pub ssim: Raster<f64>,
    /// LDR-FLIP.
    pub flip: Plane,
    /// HDR-FLIP.
    pub flip_hdr: Plane,
    /// Grain.
    pub grain: Raster<PixelGrain>,
    /// Label total variation.
    pub label: Raster<f64>,
}

/// Errors of a pixel that depend on no other.
#[derive(Clone, Copy)]
pub struct PixelErrors {
    /// `(F - A)(F - B)`.
    pub squared: f64,
    /// `squared` over the squared truth.
    pub relative: f64,
    /// `|F - T|`.
    pub absolute: f64,
    /// `absolute` over the mean of both.
    pub symmetric: f64,
}

impl ErrorMaps {
    /// Maps the errors of `output`, also given as `displayed`, against the truth's mean; squared
    /// errors against `halves`.
    pub fn new(
        output: &Picture,
        displayed: &Displayed,
        halves: [&Image; 2],
        mean: &Picture,
        seen: &SeenTruth,
    ) -> Self {
        let flip = seen.display.map_errors(&displayed.linear);
        let flip_hdr = seen.exposures.map_errors(&output.color);
        let ssim = map_ssim(&displayed.srgb, &seen.srgb);
        Self {
            pixels: map_pixel_errors(&output.color, halves, &mean.color, seen.scale),
            ssim,
            flip,
            flip_hdr,
            grain: seen.grain.map(&output.color, halves),
            label: label_variation(&output.coverage, &mean.coverage),
        }
    }

    /// Converts the maps to planes, and adds more.
    pub fn into_maps(self, output: &Picture, mean: &Picture, more: MoreMaps) -> Maps {
        let part = |error: fn(&PixelErrors) -> f64| {
            map_pixels(&self.pixels, |errors| error(errors) as f32)
        };
        Maps {
            signed_error: zip_pixels(&output.color, &mean.color, |output, truth| {
                std::array::from_fn(|c| output[c] - truth[c])
            }),
            squared_error: part(|errors| errors.squared),
            relative_squared_error: part(|errors| errors.relative),
            absolute_error: part(|errors| errors.absolute),
            symmetric_error: part(|errors| errors.symmetric),
            ssim: narrow(&self.ssim),
            flip: self.flip,
            flip_hdr: self.flip_hdr,
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
    /// `(F - A)(F - B)` for the truth with frozen shading.
    pub frozen_squared: Raster<f64>,
    /// Change of the instant's colour where nothing moves.
    pub static_change: Raster<f64>,
}

fn map_pixel_errors(
    output: &Image,
    [a, b]: [&Image; 2],
    mean: &Image,
    scale: f64,
) -> Raster<PixelErrors> {
    assert!(
        [a, b, mean].iter().all(|image| image.same_size(output)),
        "pictures were checked before they are measured"
    );
    index_pixels(output, |at| {
        let [output, a, b, mean] = [output, a, b, mean].map(|image| image.pixels[at]);
        PixelErrors {
            squared: squared(output, [a, b], scale),
            relative: relative_squared(output, [a, b], mean, scale),
            absolute: absolute(output, mean, scale),
            symmetric: symmetric(output, mean, scale),
        }
    })
}

/// Rounds a plane to `f32`, to be stored.
fn narrow(map: &Raster<f64>) -> Plane {
    map_pixels(map, |value| *value as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_map_of_a_pixel_holds_its_own_error() {
        let pixel = |value: f32| Image::filled(1, 1, [value; 3]);
        let truth = pixel(0.25);
        let errors = map_pixel_errors(&pixel(0.5), [&truth, &truth], &truth, 1.0);
        let own = errors.at(0, 0);
        assert_eq!([own.squared, own.absolute], [0.0625, 0.25]);
        // 0.0625 / 0.0625, and 2 x 0.25 / (0.5 + 0.25), except for what keeps black from dividing
        // by 0.
        assert!((own.relative - 1.0).abs() < 0.2, "{}", own.relative);
        assert!(
            (own.symmetric - 2.0 / 3.0).abs() < 0.02,
            "{}",
            own.symmetric
        );
    }
}
