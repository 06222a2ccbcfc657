//! Pixels that moving surfaces reach while a shutter is open.

use frame::{Raster, Shutter, Vectors};

/// Smallest motion while the shutter is open, in pixels.
pub const LEAST_MOTION: f32 = 0.1;

/// Marks the pixels that the frame's surfaces cross while the shutter is open, by their velocity.
pub fn mark_reached(velocity: &Vectors, shutter: Shutter) -> Raster<bool> {
    let (width, height) = (velocity.width, velocity.height);
    let mut reached = velocity.map(|_| false);
    for (at, motion) in (0_u32..).zip(&velocity.pixels) {
        let length = motion[0].hypot(motion[1]) * shutter.exposure() as f32;
        if length < LEAST_MOTION {
            continue;
        }
        // Two steps per pixel miss none; beyond twice the picture nothing is visible.
        let steps = (2.0 * length.min(2.0 * (width + height) as f32)).ceil() as u32;
        for step in 0..=steps {
            let time = shutter.at(f64::from(step) / f64::from(steps)) as f32;
            let x = ((at % width) as f32 + 0.5 + motion[0] * time).floor();
            let y = ((at / width) as f32 + 0.5 + motion[1] * time).floor();
            if x >= 0.0 && y >= 0.0 && x < width as f32 && y < height as f32 {
                reached.pixels[y as usize * width as usize + x as usize] = true;
            }
        }
    }
    reached
}

#[cfg(test)]
mod tests {
    use frame::Alignment;

    use super::*;

    #[test]
    fn what_velocity_reaches_is_marked() {
        // Two pixels to the right per frame, with the shutter open for one frame before the
        // instant.
        let velocity = Raster::from_fn(8, 1, |x, _| [if x == 4 { 2.0 } else { 0.0 }, 0.0]);
        let shutter = Alignment::Trailing.shutter(1.0).unwrap();
        let reached = mark_reached(&velocity, shutter);
        let signs = reached.pixels.iter().map(|is| if *is { 'x' } else { '.' });
        assert_eq!(signs.collect::<String>(), "..xxx...");
    }
}
