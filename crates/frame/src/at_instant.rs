//! Surfaces that the open shutter sees, as they were at the frame's instant.

use half::f16;

use crate::exr::{ExrFile, in_layer};
use crate::raster::{mean_plane, mean_vectors};
use crate::{FileError, Image, Plane, Raster, Vectors};

/// Surfaces that the open shutter sees, as they were at the instant: which of them a filter could
/// know. Values are means over all samples of the shutter and the pixel's area, so that means of
/// several renders are exact. All rasters have the same size.
#[derive(Clone, Debug, PartialEq)]
pub struct AtInstant {
    /// Change of the radiance if each visible point sends what it sent at `t = 0`: see
    /// [`AtInstant::frozen`]. Zero outside [`shaded_region`](crate::shaded_region). A replicate
    /// stores half floats: see [`AtInstant::rounded`].
    pub shift: Image,
    /// Fraction with a visible point that the instant's frame does not show: it was outside the
    /// picture, hidden, or showed its other side. Zero outside the same region.
    pub unknowable: Plane,
    /// Fraction with a visible point that has a place at the instant: all that was not behind the
    /// camera. Divide the next fields by it to get means over that fraction.
    pub placed: Plane,
    /// Offset from the pixel's centre to the visible point's place at the instant, in pixels, +x
    /// right, +y down; zero for a point without a place, and outside the moving region. A replicate
    /// stores half floats.
    pub offset: Vectors,
    /// Squares xx and yy of that offset, in square pixels; the same applies.
    pub spread: Vectors,
}

const OFFSET: [&str; 2] = ["x", "y"];
const SPREAD: [&str; 2] = ["xx", "yy"];

impl AtInstant {
    /// Makes the state of unknown surfaces: none has a place at the instant.
    pub fn unknown(width: u32, height: u32) -> AtInstant {
        let nothing = Plane::filled(width, height, 0.0);
        AtInstant {
            shift: Raster::filled(width, height, [0.0; 3]),
            unknowable: nothing.clone(),
            placed: nothing,
            offset: Raster::filled(width, height, [0.0; 2]),
            spread: Raster::filled(width, height, [0.0; 2]),
        }
    }

    /// Makes the picture with shading frozen at the instant from the picture of the open shutter:
    /// visibility changes, shading does not. It lacks shadows, reflections and lights that move,
    /// which no frame of the instant shows. The change is an unbiased estimate, so its noise may
    /// push the picture below 0.
    pub fn frozen(&self, color: &Image) -> Image {
        color.zip(&self.shift, |color, shift| {
            std::array::from_fn(|component| color[component] + shift[component])
        })
    }

    /// Rounds all but fractions to half floats, which have 11 significant bits: the error is at
    /// most 1 part in 4096, far below the noise of a replicate, and its file shrinks by half.
    /// Values larger than any half float stay. Means of replicates are not rounded.
    pub fn rounded(self) -> AtInstant {
        AtInstant {
            shift: self.shift.map(|shift| shift.map(nearest_half)),
            offset: self.offset.map(|offset| offset.map(nearest_half)),
            spread: self.spread.map(|spread| spread.map(nearest_half)),
            ..self
        }
    }

    /// Sets offsets and their squares to 0 outside a region. Where nothing moves they are the means
    /// of places within a pixel, which no score is about, and which fill a third of a file.
    pub fn within(self, region: &Raster<bool>) -> AtInstant {
        let keep = |vector: &[f32; 2], inside: &bool| if *inside { *vector } else { [0.0; 2] };
        AtInstant {
            offset: self.offset.zip(region, keep),
            spread: self.spread.zip(region, keep),
            ..self
        }
    }

    /// Averages at least one, all of one size; sums in `f64`, in their order.
    pub fn mean<'a>(all: impl IntoIterator<Item = &'a AtInstant>) -> AtInstant {
        let all: Vec<&AtInstant> = all.into_iter().collect();
        AtInstant {
            shift: mean_vectors(all.iter().map(|one| &one.shift)),
            unknowable: mean_plane(all.iter().map(|one| &one.unknowable)),
            placed: mean_plane(all.iter().map(|one| &one.placed)),
            offset: mean_vectors(all.iter().map(|one| &one.offset)),
            spread: mean_vectors(all.iter().map(|one| &one.spread)),
        }
    }

    /// Adds `shift.R/G/B`, `unknowable`, `reference.placed`, `reference.x/y` and `reference.xx/yy`.
    pub(crate) fn push(&self, file: &mut ExrFile, layer: &str) {
        let name = |name: &str| in_layer(layer, name);
        file.push_color(&name("shift"), &self.shift);
        file.push_plane(&name("unknowable"), &self.unknowable);
        file.push_plane(&name("reference.placed"), &self.placed);
        for (axes, pairs) in [(OFFSET, &self.offset), (SPREAD, &self.spread)] {
            for (component, axis) in axes.into_iter().enumerate() {
                let plane = pairs.map(|pair| pair[component]);
                file.push_owned_plane(&name(&format!("reference.{axis}")), plane);
            }
        }
    }

    pub(crate) fn from_exr(file: &ExrFile, layer: &str) -> Result<Self, FileError> {
        let name = |name: &str| in_layer(layer, name);
        let pair = |axes: [&str; 2]| file.join(axes.map(|axis| name(&format!("reference.{axis}"))));
        Ok(Self {
            shift: file.color(&name("shift"))?,
            unknowable: file.plane(&name("unknowable"))?,
            placed: file.plane(&name("reference.placed"))?,
            offset: pair(OFFSET)?,
            spread: pair(SPREAD)?,
        })
    }
}

/// Returns the nearest half float; a value larger than any stays as it is.
fn nearest_half(value: f32) -> f32 {
    let half = f16::from_f32(value);
    if half.is_finite() {
        half.to_f32()
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rounded_state_holds_the_nearest_halves() {
        // Halves from 1 to 2 are 1/1024 apart, and the largest is 65504.
        let step = 1.0 / 1024.0;
        let (given, nearest) = (
            [1.0 + 0.4 * step, -1.0 - 0.6 * step, 1e6],
            [1.0, -1.0 - step, 1e6],
        );
        let state = AtInstant {
            offset: Raster::filled(1, 1, [given[0], given[1]]),
            spread: Raster::filled(1, 1, [given[2], given[1]]),
            placed: Raster::filled(1, 1, given[0]),
            ..AtInstant::unknown(1, 1)
        };
        let expected = AtInstant {
            offset: Raster::filled(1, 1, [nearest[0], nearest[1]]),
            spread: Raster::filled(1, 1, [nearest[2], nearest[1]]),
            ..state.clone()
        };
        assert_eq!(state.rounded(), expected);
    }
}
