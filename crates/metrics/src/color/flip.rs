//! FLIP: the difference that a person sees when flipping between two pictures.
//!
//! Andersson et al., "FLIP: A Difference Evaluator for Alternating Images" (HPG 2020), and "Visualizing Errors in
//! Rendered High Dynamic Range Images" (Eurographics short papers 2021). Both are computed by `flip-rs`.

use flip_rs::{DEFAULT_PPD, HdrOptions, RgbImage, hdr_flip, ldr_flip};
use frame::{Image, Plane, Raster, display_srgb};

use crate::Viewing;

/// Maps LDR-FLIP, in [0, 1], of scene-linear images at `viewing.stops`, seen at 67.02 pixels per degree: a monitor
/// 0.7 m wide with 3840 pixels, from 0.7 m away. The images are finite and of one size.
pub fn flip_ldr(truth: &Image, output: &Image, viewing: &Viewing) -> Plane {
    let [reference, test] =
        [truth, output].map(|image| interleave(&display_srgb(image, viewing.stops)));
    let map = ldr_flip(&reference, &test, DEFAULT_PPD).expect(CHECKED);
    to_plane(truth, map.into_pixels())
}

/// Maps HDR-FLIP: the largest LDR-FLIP over the viewing's exposures, ACES tone curve, seen as in [`flip_ldr`].
///
/// The exposures are always explicit: derived from the truth, they would amplify its noise by 2^24 over a black
/// background, and change with every render.
pub fn flip_hdr(truth: &Image, output: &Image, viewing: &Viewing) -> Plane {
    let mut options = HdrOptions::default();
    options.start_exposure = Some(viewing.flip_start);
    options.stop_exposure = Some(viewing.flip_stop);
    options.num_exposures = Some(viewing.flip_count as usize);
    options.return_exposure_map = false;
    let result = hdr_flip(&interleave(truth), &interleave(output), options).expect(CHECKED);
    to_plane(truth, result.error_map.into_pixels())
}

/// Reason why FLIP refuses nothing.
const CHECKED: &str = "sizes, exposures and values were checked before they are measured";

fn interleave(image: &Image) -> RgbImage<f32> {
    let pixels = image.pixels.as_flattened().to_vec();
    RgbImage::new(image.width as usize, image.height as usize, pixels).expect(CHECKED)
}

fn to_plane(like: &Image, pixels: Vec<f32>) -> Plane {
    Raster {
        width: like.width,
        height: like.height,
        pixels,
    }
}
