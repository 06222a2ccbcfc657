//! Gradient magnitude of a matte, and its error.

use frame::Plane;

use crate::math::convolution::{filter_separably, gaussian};
use crate::math::raster::zip_pixels;
use crate::object::patch::Patch;

/// Standard deviation of the Gaussian, in pixels.
const SIGMA: f64 = 1.4;
/// Reach of the Gaussian, in standard deviations.
const REACH: f64 = 4.0;

/// Maps the magnitude of a matte's gradient, by derivatives of a Gaussian of 1.4 pixels; `None` if
/// the matte is zero, and so its gradient.
pub fn gradient_magnitude(matte: &Plane) -> Option<Patch> {
    let (bell, slope) = (gaussian(SIGMA, REACH, false), gaussian(SIGMA, REACH, true));
    let patch = Patch::cut(matte, bell.len() as u32 / 2)?;
    let across = filter_separably(&patch.raster, &slope, &bell);
    let down = filter_separably(&patch.raster, &bell, &slope);
    Some(Patch {
        raster: zip_pixels(&across, &down, |x, y| x.hypot(*y)),
        ..patch
    })
}

/// Maps the squared difference of two gradient magnitudes: Rhemann et al., "A Perceptually
/// Motivated Online Benchmark for Image Matting" (CVPR 2009), where it agrees with observers better
/// than squared differences do. `None` if both are zero.
pub fn gradient_error(a: Option<&Patch>, b: Option<&Patch>) -> Option<Patch> {
    Patch::zip(a, b, |a, b| (a - b).powi(2))
}
