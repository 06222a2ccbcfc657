//! Pixels where anything moves while an engine's shutter is open, as far as its pictures tell.

use frame::{Image, Raster, Shutter, Vectors};

/// Least change of a displayed colour between sub-frames that counts as motion: two steps of 8 bits.
const LEAST_CHANGE: f32 = 2.0 / 255.0;
/// Least motion while the shutter is open, in pixels.
const LEAST_MOTION: f32 = 0.1;

/// Least and greatest displayed colour of each pixel over the sub-frames.
pub struct ColorRange {
    /// Display exposure, in stops.
    stops: f32,
    least: Image,
    greatest: Image,
}

impl ColorRange {
    /// Starts with no sub-frame.
    pub fn new((width, height): (u32, u32), stops: f32) -> Self {
        Self {
            stops,
            least: Raster::filled(width, height, [f32::INFINITY; 3]),
            greatest: Raster::filled(width, height, [f32::NEG_INFINITY; 3]),
        }
    }

    /// Adds a sub-frame.
    pub fn add(&mut self, color: &Image) {
        let ranges = self.least.pixels.iter_mut().zip(&mut self.greatest.pixels);
        for ((least, greatest), color) in ranges.zip(&color.pixels) {
            for channel in 0..3 {
                let value = encode(color[channel], self.stops);
                least[channel] = least[channel].min(value);
                greatest[channel] = greatest[channel].max(value);
            }
        }
    }

    /// Marks the pixels whose colour changes, and those that the frame's surfaces pass on their way through the shutter.
    pub fn mark_moving(&self, velocity: &Vectors, shutter: Shutter) -> Raster<bool> {
        let mut moving = self.least.zip(&self.greatest, |least, greatest| {
            (0..3).any(|channel| greatest[channel] - least[channel] > LEAST_CHANGE)
        });
        let (width, height) = (velocity.width, velocity.height);
        for (at, motion) in (0_u32..).zip(&velocity.pixels) {
            let length = motion[0].hypot(motion[1]) * shutter.exposure() as f32;
            if length < LEAST_MOTION {
                continue;
            }
            // Two steps per pixel miss none; beyond twice the picture nothing is seen.
            let steps = (2.0 * length.min(2.0 * (width + height) as f32)).ceil() as u32;
            for step in 0..=steps {
                let time = shutter.at(f64::from(step) / f64::from(steps)) as f32;
                let x = ((at % width) as f32 + 0.5 + motion[0] * time).floor();
                let y = ((at / width) as f32 + 0.5 + motion[1] * time).floor();
                if x >= 0.0 && y >= 0.0 && x < width as f32 && y < height as f32 {
                    moving.pixels[y as usize * width as usize + x as usize] = true;
                }
            }
        }
        moving
    }
}

/// Encodes radiance about as a display does, without an end at white.
fn encode(radiance: f32, stops: f32) -> f32 {
    (radiance.max(0.0) * stops.exp2()).powf(1.0 / 2.2)
}

/// Returns the speed of the fastest pixel, in pixels per frame.
pub fn fastest(velocity: &Vectors) -> f64 {
    let speeds = velocity.pixels.iter().map(|[x, y]| x.hypot(*y));
    f64::from(speeds.fold(0.0, f32::max))
}

#[cfg(test)]
mod tests {
    use frame::Alignment;

    use super::*;

    #[test]
    fn what_passes_and_what_changes_moves() {
        let mut range = ColorRange::new((8, 1), 0.0);
        let color =
            |changed: f32| Raster::from_fn(8, 1, |x, _| [if x == 7 { changed } else { 0.5 }; 3]);
        range.add(&color(0.5));
        range.add(&color(0.6));
        // Two pixels to the right per frame, with the shutter open for one frame before the instant.
        let velocity = Raster::from_fn(8, 1, |x, _| [if x == 4 { 2.0 } else { 0.0 }, 0.0]);
        let shutter = Alignment::Trailing.shutter(1.0).unwrap();
        let moving = range.mark_moving(&velocity, shutter);
        assert_eq!(
            moving.pixels,
            [false, false, true, true, true, false, false, true]
        );
    }
}
