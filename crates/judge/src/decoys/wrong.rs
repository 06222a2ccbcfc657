//! Pictures of wrong blurs.

use frame::{Alignment, Frame, Picture, Plane, Raster, Size, Truth};
use metrics::scatter_oracle;

/// Number of sub-frames with a banded mean.
pub const FEW_SUBFRAMES: u32 = 4;
/// Pixels by which moving objects are widened.
const WIDENED: u32 = 2;
/// What a weighted mean of 16 samples is multiplied by if their weights add up to 17.
const TOO_BRIGHT: f32 = 17.0 / 16.0;

/// Makes wrong blurs of a frame without guard band, with their names. They smear like the scatter
/// oracle, the best that the frame allows, so that each has only the mistake in its name.
/// `few_subframes` is the mean of [`FEW_SUBFRAMES`], if there is one.
pub fn make_wrong_pictures(
    frame: &Frame,
    truth: &Truth,
    few_subframes: Option<Picture>,
) -> Vec<(String, Picture)> {
    let smear = |frame: &Frame, alignment: Alignment, length: f64| {
        let shutter = (alignment.shutter(length * frame.exposure))
            .expect("a part of an exposure is an exposure");
        scatter_oracle(frame, shutter, &truth.shutter_profile)
    };
    let moving_otherwise = |factors: [f32; 2]| Frame {
        velocity: frame
            .velocity
            .map(|v| [factors[0] * v[0], factors[1] * v[1]]),
        ..frame.clone()
    };
    let identity = frame.picture();
    let alignment = truth.alignment;
    let mut pictures = vec![
        ("half_length".to_owned(), smear(frame, alignment, 0.5)),
        (
            "half_as_long_again".to_owned(),
            smear(frame, alignment, 1.5),
        ),
        (
            "twice_length".to_owned(),
            smear(&moving_otherwise([2.0, 2.0]), alignment, 1.0),
        ),
        (
            "y_flipped".to_owned(),
            smear(&moving_otherwise([1.0, -1.0]), alignment, 1.0),
        ),
        (
            "too_bright".to_owned(),
            brighten(&smear(frame, alignment, 1.0)),
        ),
        ("widened".to_owned(), smear(&widen(frame), alignment, 1.0)),
        ("one_color".to_owned(), one_color(&identity)),
        ("no_blur".to_owned(), identity),
    ];
    for other in Alignment::ALL {
        if other != alignment {
            pictures.push((format!("{other}_shutter"), smear(frame, other, 1.0)));
        }
    }
    if let Some(mean) = few_subframes {
        pictures.push((format!("mean_of_{FEW_SUBFRAMES}_sub_frames"), mean));
    }
    pictures
}

/// Widens everything that moves by some pixels on all sides.
fn widen(frame: &Frame) -> Frame {
    let Size { width, height } = frame.size();
    let nearest = Raster::from_fn(width, height, |x, y| {
        let around = |middle: u32, size: u32| {
            middle.saturating_sub(WIDENED)..=(middle + WIDENED).min(size - 1)
        };
        let pixel = (y * width + x) as usize;
        let candidates = around(y, height).flat_map(|v| around(x, width).map(move |u| (u, v)));
        candidates
            .map(|(u, v)| (v * width + u) as usize)
            .filter(|at| frame.velocity.pixels[*at] != [0.0, 0.0])
            .fold(pixel, |best, at| {
                if frame.depth.pixels[at] < frame.depth.pixels[best] {
                    at
                } else {
                    best
                }
            })
    });
    Frame {
        color: nearest.map(|at| frame.color.pixels[*at]),
        velocity: nearest.map(|at| frame.velocity.pixels[*at]),
        depth: nearest.map(|at| frame.depth.pixels[*at]),
        coverage: (frame.coverage.iter())
            .map(|plane| nearest.map(|at| plane.pixels[*at]))
            .collect(),
        ..frame.clone()
    }
}

/// Multiplies everything by [`TOO_BRIGHT`].
fn brighten(picture: &Picture) -> Picture {
    Picture {
        color: (picture.color).map(|pixel| pixel.map(|value| TOO_BRIGHT * value)),
        coverage: (picture.coverage.iter())
            .map(|plane| plane.map(|share| TOO_BRIGHT * share))
            .collect(),
    }
}

/// Fills a picture with its mean.
fn one_color(picture: &Picture) -> Picture {
    let count = picture.color.pixels.len() as f64;
    let mean =
        |values: &mut dyn Iterator<Item = f32>| (values.map(f64::from).sum::<f64>() / count) as f32;
    let color = [0, 1, 2].map(|channel| mean(&mut picture.color.pixels.iter().map(|p| p[channel])));
    let fill = |plane: &Plane| {
        let mean = mean(&mut plane.pixels.iter().copied());
        plane.map(|_| mean)
    };
    Picture {
        color: picture.color.map(|_| color),
        coverage: picture.coverage.iter().map(fill).collect(),
    }
}
