//! FLIP: the difference that a person sees when flipping between two pictures.
//!
//! Andersson et al., "FLIP: A Difference Evaluator for Alternating Images" (HPG 2020), and
//! "Visualizing Errors in Rendered High Dynamic Range Images" (Eurographics short papers 2021), as
//! NVIDIA's tool 1.7 computes them. Sums are taken in the tool's order, in 32 bits; powers are
//! rounded from 64 bits. Every pixel has its own sums, so that the bytes are the same on any number
//! of threads.
//!
//! `flip-rs` 0.1.2 computes the same and would save these files. It is not used: it changes the
//! last digits of every FLIP in run.json, so that each baseline would differ; it refuses pictures
//! above 28.5 million pixels, such as 8K; it filters the truth again for every picture; and its
//! three releases are of one hour in October 2026.
//!
//! | file | holds |
//! |---|---|
//! | `weights` | weights of the filters |
//! | `space` | conversions of colour |
//! | `filter` | filters of one picture, as the eye filters it |
//! | `seen` | pictures as the eye sees them, and their difference |

mod filter;
mod seen;
mod space;
mod weights;

use frame::{Image, Plane, Raster, decode_srgb, display_srgb};

use crate::Viewing;
use crate::math::raster::map_pixels;
use filter::Exposure;
use seen::{Seen, raise_to_errors};

/// Upper limit on the exposures of HDR-FLIP.
pub const MAX_EXPOSURES: u32 = 128;

/// Maps LDR-FLIP, in [0, 1], of scene-linear images at `viewing.stops`, seen at 67.02 pixels per
/// degree: a monitor 0.7 m wide with 3840 pixels, from 0.7 m away. The images are finite and of one
/// size.
pub fn flip_ldr(truth: &Image, output: &Image, viewing: &Viewing) -> Plane {
    let [truth, output] = [truth, output].map(|image| Displayed::new(image, viewing));
    SeenExposures::of_display(&truth).map_errors(&output.linear)
}

/// Maps HDR-FLIP: the largest LDR-FLIP over the viewing's exposures, ACES tone curve, seen as in
/// [`flip_ldr`].
///
/// The exposures are always explicit: derived from the truth, they would amplify its noise by 2^24
/// over a black background, and change with every render.
pub fn flip_hdr(truth: &Image, output: &Image, viewing: &Viewing) -> Plane {
    SeenExposures::new(truth, viewing).map_errors(output)
}

/// A picture as a display shows it.
pub struct Displayed {
    /// Values in [0, 1] for sRGB.
    pub srgb: Image,
    /// The same, decoded: light in [0, 1].
    pub linear: Image,
}

impl Displayed {
    /// Shows scene-linear radiance at the viewing's exposure.
    pub fn new(image: &Image, viewing: &Viewing) -> Self {
        let srgb = display_srgb(image, viewing.stops);
        let linear = map_pixels(&srgb, |color| color.map(decode_srgb));
        Self { srgb, linear }
    }
}

/// A truth as the eye sees it, for FLIP of any number of pictures: on a display, or at each
/// exposure of HDR-FLIP.
pub struct SeenExposures(Vec<(Exposure, Seen)>);

impl SeenExposures {
    /// Filters light of a display, for LDR-FLIP.
    pub fn of_display(truth: &Displayed) -> Self {
        let seen = Seen::new(&truth.linear, Exposure::Display);
        Self(vec![(Exposure::Display, seen)])
    }

    /// Filters scene-linear radiance at every exposure of the viewing.
    pub fn new(truth: &Image, viewing: &Viewing) -> Self {
        let exposures = list_exposures(viewing).into_iter();
        Self(
            exposures
                .map(|exposure| (exposure, Seen::new(truth, exposure)))
                .collect(),
        )
    }

    /// Maps FLIP of a picture in the truth's form: light of a display, or scene-linear radiance.
    pub fn map_errors(&self, output: &Image) -> Plane {
        let mut map = Raster::filled(output.width, output.height, 0.0);
        for (exposure, seen) in &self.0 {
            raise_to_errors(&mut map, seen, output, *exposure);
        }
        map
    }
}

/// Lists all exposures; one if both ends are equal.
fn list_exposures(viewing: &Viewing) -> Vec<Exposure> {
    let Viewing {
        flip_start: start,
        flip_stop: stop,
        flip_count,
        ..
    } = *viewing;
    let step = (stop - start) / (flip_count - 1) as f32;
    let count = if start == stop { 1 } else { flip_count };
    (0..count)
        .map(|exposure| Exposure::Factor(2.0_f32.powf(start + exposure as f32 * step)))
        .collect()
}
