//! Times of an animation: frames of a scene as seconds from 0.

use scene::Scene;

/// Frames per second of every animation.
pub const FRAMES_PER_SECOND: f64 = 24.0;

/// Smallest number of frames before and after the instant: the previous frame, and a shutter that
/// is open for a whole frame.
const LEAST_REACH: f64 = 2.0;

/// Part of a scene's time in an animation. Players hold still before its first key and after its
/// last, so it reaches beyond every shutter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timeline {
    /// Whole frames before and after the instant.
    pub reach: f64,
}

impl Timeline {
    /// Makes a timeline that includes every shutter of a scene, in any alignment, and the frame
    /// before the instant.
    pub fn of(scene: &Scene) -> Self {
        let shutter = scene.exposure + scene.shutter_profile.rolling.abs();
        Self {
            reach: shutter.ceil().max(LEAST_REACH),
        }
    }

    /// Converts a time in frames relative to the instant to seconds from the start.
    pub fn seconds(&self, time: f64) -> f64 {
        (time + self.reach) / FRAMES_PER_SECOND
    }

    /// Lists times of keys within the timeline and both ends, rising, each once.
    pub fn cut(&self, keys: impl IntoIterator<Item = f64>) -> Vec<f64> {
        let inside = (keys.into_iter()).filter(|time| time.abs() < self.reach);
        let mut times: Vec<f64> = inside.chain([-self.reach, self.reach]).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }
}
