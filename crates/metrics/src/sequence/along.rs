//! Pictures of the frame before, moved to where their points are now.

use frame::{Image, Raster};

use super::instant::Instant;
use crate::math::raster::index_pixels;

/// For every pixel, where the point that it shows was in the frame before.
pub struct Before {
    /// In pixels, the centre of the first pixel at (0, 0); none if the point was outside the
    /// picture or another object was in front of it.
    places: Raster<Option<[f32; 2]>>,
}

impl Before {
    /// Follows every point of `now` back to `before`. A point counts as hidden if the nearest pixel
    /// of the frame before shows another object; a point that another part of its own object hid is
    /// not noticed.
    pub fn new(before: &Instant, now: &Instant) -> Self {
        let ids = &before.object_id;
        let places = index_pixels(&now.velocity, |at| {
            let place = place_before(now, at)?;
            let [x, y] = place.map(|coordinate| coordinate.round() as u32);
            (*ids.at(x, y) == now.object_id.pixels[at]).then_some(place)
        });
        Self { places }
    }

    /// Returns whether the point of a pixel was seen in the frame before.
    pub fn is_seen(&self, at: usize) -> bool {
        self.places.pixels[at].is_some()
    }

    /// Moves a picture of the frame before to where its points are now, bilinearly; zero where they
    /// were not seen.
    pub fn take(&self, before: &Image) -> Image {
        index_pixels(&self.places, |at| {
            self.places.pixels[at].map_or([0.0; 3], |place| bilinear(before, place))
        })
    }
}

/// Finds the place in the frame before of a pixel's point, the centre of the first pixel at
/// (0, 0); none outside the picture.
fn place_before(now: &Instant, at: usize) -> Option<[f32; 2]> {
    let width = now.velocity.width as usize;
    let [x, y] = [at % width, at / width].map(|index| index as f32);
    let velocity = now.velocity.pixels[at];
    inside(now, [x - velocity[0], y - velocity[1]])
}

/// Returns a place if all pixels around it are in the picture.
pub fn inside(now: &Instant, [x, y]: [f32; 2]) -> Option<[f32; 2]> {
    let [last_x, last_y] =
        [now.velocity.width - 1, now.velocity.height - 1].map(|last| last as f32);
    ((0.0..=last_x).contains(&x) && (0.0..=last_y).contains(&y)).then_some([x, y])
}

/// Interpolates between the four nearest pixels of a place in the picture.
pub fn bilinear(image: &Image, [x, y]: [f32; 2]) -> [f32; 3] {
    let [left, top] = [x.floor() as u32, y.floor() as u32];
    let right = (left + 1).min(image.width - 1);
    let bottom = (top + 1).min(image.height - 1);
    let [along, down] = [x - left as f32, y - top as f32];
    let mix = |a: [f32; 3], b: [f32; 3], part: f32| -> [f32; 3] {
        // Exact where both are equal or the place is a pixel's centre.
        std::array::from_fn(|c| a[c] + part * (b[c] - a[c]))
    };
    let upper = mix(*image.at(left, top), *image.at(right, top), along);
    let lower = mix(*image.at(left, bottom), *image.at(right, bottom), along);
    mix(upper, lower, down)
}

#[cfg(test)]
mod tests {
    use frame::Raster;

    use super::*;

    #[test]
    fn a_place_between_pixels_is_their_weighted_mean() {
        let image = Raster::from_fn(3, 2, |x, y| [(x + 10 * y) as f32; 3]);
        for ([x, y], expected) in [([0.0, 0.0], 0.0), ([2.0, 1.0], 12.0), ([0.5, 0.25], 3.0)] {
            assert_eq!(bilinear(&image, [x, y]), [expected; 3]);
        }
    }
}
