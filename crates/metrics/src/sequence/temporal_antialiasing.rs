//! Common temporal anti-aliasing, to show how much of a sequence's noise it would leave.

use frame::Image;

use super::along::{bilinear, inside};
use super::instant::Instant;
use crate::math::raster::{around, index_pixels};

/// Share of the new picture in the mean.
pub const NEW_SHARE: f32 = 0.1;

/// Accumulates pictures of consecutive frames; returns the accumulated picture of each.
///
/// Every pixel is the mean of its new colour, by [`NEW_SHARE`], and of its history. The history is
/// the accumulated picture of the frame before, bilinearly at the place that the velocity leads
/// back to. The velocity comes from the nearest of the nine pixels around (Karis 2014), so that
/// edges keep their history. The history is clamped, channel by channel, to the least and the
/// greatest of the nine new colours around. The first frame and points from outside the picture
/// have no history.
pub fn accumulate(pictures: &[Image], instants: &[Instant]) -> Vec<Image> {
    assert_eq!(pictures.len(), instants.len(), "every frame has a picture");
    let mut accumulated: Vec<Image> = Vec::with_capacity(pictures.len());
    for (new, instant) in pictures.iter().zip(instants) {
        let mean = match accumulated.last() {
            None => new.clone(),
            Some(history) => index_pixels(new, |at| blend(history, new, instant, at)),
        };
        accumulated.push(mean);
    }
    accumulated
}

fn blend(history: &Image, new: &Image, instant: &Instant, at: usize) -> [f32; 3] {
    let color = new.pixels[at];
    let velocity = instant.velocity.pixels[nearest_around(instant, at)];
    let width = new.width as usize;
    let [x, y] = [at % width, at / width].map(|index| index as f32);
    let Some(place) = inside(instant, [x - velocity[0], y - velocity[1]]) else {
        return color;
    };
    let history = bilinear(history, place);
    let (mut least, mut greatest) = (color, color);
    for near in around(new, at, 1) {
        for c in 0..3 {
            least[c] = least[c].min(new.pixels[near][c]);
            greatest[c] = greatest[c].max(new.pixels[near][c]);
        }
    }
    std::array::from_fn(|c| {
        let history = history[c].clamp(least[c], greatest[c]);
        history + NEW_SHARE * (color[c] - history)
    })
}

/// Finds the pixel with the least depth among the nine around one; itself among equals.
fn nearest_around(instant: &Instant, at: usize) -> usize {
    let depth = &instant.depth;
    around(depth, at, 1).fold(at, |nearest, other| {
        if depth.pixels[other] < depth.pixels[nearest] {
            other
        } else {
            nearest
        }
    })
}
