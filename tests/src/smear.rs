//! Length of a preset's smear on the scene `sliding_panel`, in degrees of the frame.

use filters::{Filter, Input, Settings};

use crate::panel::{Mover, Shot};
use crate::picture::frame_input;
use crate::ramp::Ramp;
use crate::ready_blur;

/// Speed of the measured panel, in pixels per frame: fast enough that whole pixels make little
/// difference, and slow enough that no engine cuts one frame's motion in a picture as wide as
/// [`FULL_SIZE`].
const SPEED: f64 = 24.0;
/// Columns and rows of the pictures that engines' lengths are stated for.
pub const FULL_SIZE: [u32; 2] = [1920, 1080];

/// Traces the panel for [`smear_degrees`], moving to the right.
pub fn measured_shot(mover: Mover, size: [u32; 2]) -> Shot {
    Shot::of_motion(mover, size, [SPEED, 0.0, 0.5])
}

/// Returns the length of a smear with the shutter open for `exposure` frames, at 60 frames per
/// second, in degrees of the frame: 360 are one frame's motion. It is the length of the even smear
/// that spreads an edge as far. Lengths in pixels are those of [`FULL_SIZE`] in pictures of any
/// size, so that a smaller one is a part of it.
pub fn smear_degrees(shot: &Shot, filter: &Filter, settings: &Settings, exposure: f64) -> f64 {
    let settings = settings.scaled_to(filter, FULL_SIZE[0]);
    let mut blur = ready_blur(filter, &settings, shot.size);
    let color = shot.painted.map(|value| [*value; 3]);
    let colors = [&color];
    let input = Input {
        exposure,
        frames_per_second: Some(60.0),
        ..frame_input(&shot.frame, &colors)
    };
    let blurred = blur.run(&input).expect("the filter runs").remove(0);
    let ramp = Ramp::of(&shot.profile(&blurred.map(|[value, ..]| *value)));
    360.0 * ramp.beyond(shot.painted_ramp).length / shot.speed
}
