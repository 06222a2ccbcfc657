//! Mixtures of colour and probe: what a filter with weights independent of colour makes of one is
//! the mixture of what it makes of both.

use frame::Image;

/// Mixes half of one and a hundredth of the other, which has values some hundred times as large.
pub fn mix(color: &Image, probe: &Image) -> Image {
    color.zip(probe, |color, probe| {
        std::array::from_fn(|c| 0.5 * color[c] + 0.01 * probe[c])
    })
}

/// Compares the blur of a mixture with the mixture of the blurs. The blur's change counts as at
/// least a thousandth of the picture, so that rounding does not count as a dependence on colour.
pub fn nonlinearity(mixture: &Image, blurred: &Image, expected: &Image) -> f64 {
    const LEAST_CHANGE: f64 = 1e-3;
    let length = |a: &Image, b: &Image| {
        let squares = a.zip(b, |a, b| -> f64 {
            (0..3).map(|c| f64::from(a[c] - b[c]).powi(2)).sum()
        });
        squares.pixels.iter().sum::<f64>().sqrt()
    };
    let nothing = mixture.map(|_| [0.0; 3]);
    let change = length(blurred, mixture).max(LEAST_CHANGE * length(mixture, &nothing));
    length(blurred, expected) / change.max(f64::MIN_POSITIVE)
}
