//! Label total variation: the fraction of the shutter that is given to the wrong object.

use frame::{Plane, Raster};

/// Maps half the sum over objects of `|a - a*|`, in [0, 1] for mattes that sum to 1: the fraction of the shutter during which a
/// pixel shows another object than it should. Texture does not matter.
pub fn label_variation(output: &[Plane], truth: &[Plane]) -> Raster<f64> {
    let first = truth.first().expect("a truth has a background");
    let mut sum = first.map(|_| 0.0);
    for (output, truth) in output.iter().zip(truth) {
        let wrong = output.zip(truth, |a, b| (f64::from(*a) - f64::from(*b)).abs() / 2.0);
        sum = sum.zip(&wrong, |sum, wrong| sum + wrong);
    }
    sum
}

/// Averages a label total variation over the pixels of `inside`, weighted by the object's true matte: the error on the object
/// itself. `None` if the object is not seen inside.
pub fn average_on_object(
    variation: &Raster<f64>,
    truth: &Plane,
    inside: &Raster<bool>,
) -> Option<f64> {
    let weights = truth.zip(
        inside,
        |matte, inside| {
            if *inside { f64::from(*matte) } else { 0.0 }
        },
    );
    let weight: f64 = weights.pixels.iter().sum();
    let wrong: f64 = weights.zip(variation, |w, v| w * v).pixels.iter().sum();
    (weight > 0.0).then(|| wrong / weight)
}
