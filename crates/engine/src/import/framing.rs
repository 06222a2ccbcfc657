//! The camera that an import frames on a model.

use std::ops::RangeInclusive;

use frame::Size;

/// Size of the picture.
pub const SIZE: Size = Size::new(640, 360);

/// Vertical field of view, in degrees.
pub const VERTICAL_FOV: f64 = 40.0;

/// Angles of the camera around and above the model, in degrees.
pub const VIEW: [f64; 2] = [25.0, 15.0];

/// Part of the picture's height that the ball around the model fills.
const FILLED: f64 = 0.75;

/// Radii of models that can be imported, in metres.
const RADII: RangeInclusive<f64> = 1e-6..=1e9;

/// Returns how far the camera is from the middle of a model, in metres.
pub fn distance(radius: f64) -> f64 {
    radius / (FILLED * (0.5 * VERTICAL_FOV).to_radians().sin())
}

/// Refuses a model that no camera can be framed on.
pub fn check_radius(radius: f64) -> Result<(), String> {
    let [least, greatest] = [RADII.start(), RADII.end()];
    if RADII.contains(&radius) {
        Ok(())
    } else {
        Err(format!(
            "the model's radius is {radius:e} m; allowed: {least:e} to {greatest:e}; scale it"
        ))
    }
}
