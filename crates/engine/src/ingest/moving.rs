//! Pixels that change their colour while an engine's shutter is open, and how fast they move.

use frame::{Image, Raster, Size, Vectors};
use measure::LEAST_MOTION;

/// Smallest change of a displayed colour between sub-frames that counts as motion: two steps of 8
/// bits.
const LEAST_CHANGE: f32 = 2.0 / 255.0;
/// Share of the moving pixels that are no faster than the usual top speed.
const TOP_SHARE: f64 = 0.99;

/// Smallest and largest displayed colour of each pixel over the sub-frames.
pub struct ColorRange {
    /// Display exposure, in stops.
    stops: f32,
    least: Image,
    greatest: Image,
}

impl ColorRange {
    /// Starts with no sub-frame.
    pub fn new(Size { width, height }: Size, stops: f32) -> Self {
        Self {
            stops,
            least: Raster::filled(width, height, [f32::INFINITY; 3]),
            greatest: Raster::filled(width, height, [f32::NEG_INFINITY; 3]),
        }
    }

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

    /// Marks the pixels that change colour.
    pub fn mark_changed(&self) -> Raster<bool> {
        self.least.zip(&self.greatest, |least, greatest| {
            (0..3).any(|channel| greatest[channel] - least[channel] > LEAST_CHANGE)
        })
    }
}

/// Encodes radiance about as a display does, without clipping at white.
fn encode(radiance: f32, stops: f32) -> f32 {
    (radiance.max(0.0) * stops.exp2()).powf(1.0 / 2.2)
}

/// Returns the 99th percentile of the moving pixels' speed, in pixels per frame; 0 if nothing
/// moves. Some engines leave absurd velocities in a few pixels.
pub fn usual_top_speed(velocity: &Vectors) -> f64 {
    let speeds = velocity.pixels.iter().map(|[x, y]| x.hypot(*y));
    let mut moving: Vec<f32> = speeds.filter(|speed| *speed >= LEAST_MOTION).collect();
    moving.sort_by(f32::total_cmp);
    let at = (moving.len() as f64 * TOP_SHARE).ceil() as usize;
    let top = moving.get(at.saturating_sub(1));
    top.map_or(0.0, |speed| f64::from(*speed))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_absurd_velocities_do_not_count() {
        let speeds = |absurd: usize| {
            let mut speeds = Raster::from_fn(20, 20, |x, _| [if x < 10 { 4.0 } else { 0.0 }, 0.0]);
            speeds.pixels[..absurd].fill([1e5, 0.0]);
            usual_top_speed(&speeds)
        };
        // 200 pixels move.
        assert_eq!([speeds(0), speeds(2), speeds(3)], [4.0, 4.0, 1e5]);
        assert_eq!(usual_top_speed(&Raster::filled(4, 4, [0.0; 2])), 0.0);
    }

    #[test]
    fn what_changes_is_marked() {
        let mut range = ColorRange::new(Size::new(8, 1), 0.0);
        let color =
            |changed: f32| Raster::from_fn(8, 1, |x, _| [if x == 7 { changed } else { 0.5 }; 3]);
        range.add(&color(0.5));
        range.add(&color(0.6));
        let marks = |marks: Raster<bool>| -> String {
            let signs = marks.pixels.iter().map(|is| if *is { 'x' } else { '.' });
            signs.collect()
        };
        assert_eq!(marks(range.mark_changed()), ".......x");
    }
}
