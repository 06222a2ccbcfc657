//! The field of view of a camera as a function of time.

use crate::model::Camera;
use crate::motion::curve::{Cubic, Keyed};

impl Camera {
    /// Vertical field of view at `time` (frames), in radians.
    pub fn vertical_fov_at(&self, time: f64) -> f64 {
        let (start, curve) = self.vertical_fov_curve(time);
        curve.at(time - start)
    }

    /// Returns true if it has one place, one direction and one field of view.
    pub fn stands_still(&self) -> bool {
        self.motion.keys.len() <= 1 && self.vertical_fov.len() <= 1
    }

    /// Times within `[from, to]` at which the field of view may be greatest or least: the ends,
    /// keys and turning points.
    pub fn vertical_fov_extremes(&self, from: f64, to: f64) -> Vec<f64> {
        let keys = self.vertical_fov.iter().map(|(time, _)| *time);
        let turns = keys.clone().flat_map(|key| {
            let (start, curve) = self.vertical_fov_curve(key);
            curve.turning_points().map(move |since| start + since)
        });
        let inside = keys.chain(turns).filter(|time| from < *time && *time < to);
        inside.chain([from, to]).collect()
    }

    fn keyed_fov(&self) -> Keyed<'_, (f64, f64)> {
        Keyed {
            keys: &self.vertical_fov,
            time: |(time, _): &(f64, f64)| *time,
            interpolation: self.motion.interpolation,
        }
    }

    /// The curve of the field of view around `time`, and the time that it counts from.
    fn vertical_fov_curve(&self, time: f64) -> (f64, Cubic<f64>) {
        self.fov_curve_at(self.keyed_fov().segment(time))
    }

    fn fov_curve_at(&self, segment: usize) -> (f64, Cubic<f64>) {
        let keyed = self.keyed_fov();
        let keys = keyed.keys;
        let chord = |from: usize| (keys[from + 1].1 - keys[from].1) / keyed.duration(from);
        let curve = keyed.curve(segment, |key| keys[key].1, chord);
        (keys[keyed.anchor(segment)].0, curve)
    }

    /// The derivative of the field of view just before `time` (frames), in radians per frame.
    pub fn vertical_fov_rate_before(&self, time: f64) -> f64 {
        let (start, fov) = self.fov_curve_at(self.keyed_fov().segment_before(time));
        fov.slope(time - start)
    }
}
