//! Label total variation: the fraction of the shutter that is given to the wrong object.

use frame::{Plane, Raster};

use crate::math::raster::index_pixels;

/// Maps half the sum over objects of `|a - a*|`, in [0, 1] for mattes that sum to 1: the fraction
/// of the shutter during which a pixel shows the wrong object. Texture does not matter.
pub fn label_variation(output: &[Plane], truth: &[Plane]) -> Raster<f64> {
    let first = truth.first().expect("a truth has a background");
    index_pixels(first, |at| {
        let pairs = output.iter().zip(truth);
        pairs.fold(0.0, |sum, (output, truth)| {
            let (a, b) = (f64::from(output.pixels[at]), f64::from(truth.pixels[at]));
            sum + (a - b).abs() / 2.0
        })
    })
}

/// Averages a map of errors over the pixels of `inside`, weighted by the object's true matte: the
/// error on the object itself. `None` if the object is not seen inside.
pub fn average_on_object<T: Copy + Into<f64>>(
    errors: &Raster<T>,
    truth: &Plane,
    inside: &Raster<bool>,
) -> Option<f64> {
    let (mut weight, mut wrong) = (0.0, 0.0);
    let pixels = truth.pixels.iter().zip(&inside.pixels);
    for ((matte, inside), error) in pixels.zip(&errors.pixels) {
        if *inside {
            weight += f64::from(*matte);
            wrong += f64::from(*matte) * (*error).into();
        }
    }
    (weight > 0.0).then(|| wrong / weight)
}
