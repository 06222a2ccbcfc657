//! Noise that a picture has from the frame, and the truth has, too.

use frame::{Image, Raster, Regions};

use crate::math::raster::index_pixels;

/// Largest change of a colour, relative to it, that counts as none: the rounding of 16-bit floats.
const ROUNDING: f32 = 1e-3;

/// Marks the pixels in which the frame has the truth's noise. Where nothing moves, both were
/// rendered with the same random numbers, unless the frame came from elsewhere: it has the truth's
/// noise if it differs from the mean by less than half as much as the halves.
pub fn mark_shared(
    instant: &Image,
    [a, b]: [&Image; 2],
    mean: &Image,
    regions: &Regions,
) -> Raster<bool> {
    let is_still = |at: usize| !regions.support.pixels[at];
    let sum = |error: &dyn Fn(usize, usize) -> f32| -> f64 {
        let still = (0..mean.pixels.len()).filter(|at| is_still(*at));
        let square = |at: usize| (0..3).map(|c| f64::from(error(at, c)).powi(2)).sum::<f64>();
        still.map(square).sum()
    };
    let difference = sum(&|at, c| instant.pixels[at][c] - mean.pixels[at][c]);
    let noise = sum(&|at, c| 0.5 * (a.pixels[at][c] - b.pixels[at][c]));
    index_pixels(mean, |at| difference < 0.5 * noise && is_still(at))
}

/// Returns the halves of a truth for the squared error of a picture that a filter made from the
/// frame.
///
/// The product of the differences from two halves takes out the truth's noise if the picture has
/// none of it. A filter that leaves a `shared` pixel alone hands on the noise that frame and truth
/// have in common. It cancels in the difference from the mean, and so the mean stands for both
/// halves there.
pub fn halves_for(
    output: &Image,
    instant: &Image,
    shared: &Raster<bool>,
    halves: [&Image; 2],
    mean: &Image,
) -> [Image; 2] {
    let is_handed_on = |at: usize| {
        let [value, color] = [output, instant].map(|image| image.pixels[at]);
        let is_left = |c: usize| (value[c] - color[c]).abs() <= ROUNDING * color[c].abs();
        shared.pixels[at] && (0..3).all(is_left)
    };
    halves.map(|half| {
        index_pixels(half, |at| {
            if is_handed_on(at) {
                mean.pixels[at]
            } else {
                half.pixels[at]
            }
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(values: [f32; 4]) -> Image {
        Image::from_fn(4, 1, |x, _| [values[x as usize]; 3])
    }

    #[test]
    fn the_mean_stands_for_the_halves_where_a_still_pixel_is_left_alone() {
        let [a, b, mean] = [[0.5; 4], [1.5; 4], [1.0; 4]].map(image);
        let shared = Raster::from_fn(4, 1, |x, _| x < 3);
        // Left alone, rounded, changed, and left alone where something moves.
        let output = image([1.0, 1.0005, 1.01, 1.0]);
        let pair = halves_for(&output, &mean, &shared, [&a, &b], &mean);
        assert_eq!(pair[0], image([1.0, 1.0, 0.5, 0.5]));
        assert_eq!(pair[1], image([1.0, 1.0, 1.5, 1.5]));
    }

    #[test]
    fn a_frame_from_elsewhere_shares_no_noise() {
        let [a, b, mean] = [[0.5; 4], [1.5; 4], [1.0; 4]].map(image);
        let support = Raster::from_fn(4, 1, |x, _| x == 3);
        let regions = Regions {
            moving: support.clone(),
            still: support.map(|moves| !moves),
            knowable: support.clone(),
            unknowable: support.map(|_| false),
            support,
        };
        let shared = |instant| mark_shared(&instant, [&a, &b], &mean, &regions).pixels;
        // It may be elsewhere where something moves.
        assert_eq!(
            shared(image([1.0, 1.1, 1.0, 9.0])),
            [true, true, true, false]
        );
        assert_eq!(shared(image([1.0, 1.8, 1.0, 1.0])), [false; 4]);
    }
}
