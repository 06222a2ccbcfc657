//! Keys dense enough that nothing strays between them.

use glam::DVec2;

use super::moment::{Mark, Moment};

/// Farthest that a point may stray between two keys, in pixels, and farthest that a velocity may
/// be off where a frame is drawn, in pixels per frame.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    pub stray: f64,
    pub velocity: f64,
}

/// Most keys of one object.
const MOST_KEYS: usize = 512;

/// Shortest time between keys that halving makes, in frames.
const SHORTEST: f64 = 1.0 / 4096.0;

/// Something that moves through keys with straight paths between them.
pub trait Path {
    /// State at one time.
    type Key: Clone;

    fn key(&self, moment: Moment) -> Self::Key;

    /// Mixes two keys as the scene's motion does.
    fn mix(&self, keys: [&Self::Key; 2], part: f64) -> Self::Key;

    /// Returns where points are in the picture, in pixels; none for those that are not near it.
    fn pixels(&self, key: &Self::Key, moment: Moment) -> Vec<Option<DVec2>>;
}

/// Keys of a path, and the farthest that a point strays between them, in pixels.
#[derive(Clone, Debug)]
pub struct Keys<K> {
    pub list: Vec<(Moment, K)>,
    pub stray: f64,
}

impl<K> Keys<K> {
    /// Makes one key for something that stands still.
    pub fn still(moment: Moment, key: K) -> Self {
        Self {
            list: vec![(moment, key)],
            stray: 0.0,
        }
    }
}

/// Puts keys at the marks, and halves each interval until its tolerance holds. The error follows
/// the name of what moves.
pub fn find_keys<P: Path>(
    path: &P,
    marks: &[Mark],
    tolerance: Tolerance,
) -> Result<Keys<P::Key>, String> {
    let first = marks[0].moment;
    let mut keys = Keys::still(first, path.key(first));
    // Intervals still to be checked, by their ends; the next one is the last.
    for pair in marks.windows(2) {
        let end = (pair[1].moment, path.key(pair[1].moment));
        if pair[1].is_jump {
            keys.list.push(end);
            continue;
        }
        let mut ends = vec![end];
        while let Some((moment, key)) = ends.pop() {
            let (start, from) = keys.list.last().expect("the first key").clone();
            let interval = Interval {
                times: [start, moment],
                keys: [&from, &key],
                is_drawn: [
                    pair[0].is_drawn && start == pair[0].moment,
                    pair[1].is_drawn && moment == pair[1].moment,
                ],
            };
            let stray = interval.stray(path);
            let is_close = stray <= tolerance.stray && interval.is_velocity_right(path, tolerance);
            if is_close || moment.frame - start.frame < SHORTEST {
                keys.stray = keys.stray.max(stray);
                keys.list.push((moment, key));
            } else {
                let middle = interval.at(0.5);
                ends.push((moment, key));
                ends.push((middle, path.key(middle)));
            }
            if keys.list.len() + ends.len() > MOST_KEYS {
                return Err(format!(
                    "needs more than {MOST_KEYS} keys around frame {:.2} so that nothing strays by more than {} px; raise --fps, \
                     or import fewer frames",
                    start.frame, tolerance.stray
                ));
            }
        }
    }
    Ok(keys)
}

/// Time between two keys.
struct Interval<'a, K> {
    times: [Moment; 2],
    keys: [&'a K; 2],
    /// True for an end at which a frame is drawn.
    is_drawn: [bool; 2],
}

impl<K: Clone> Interval<'_, K> {
    /// Returns the moment after a part of the interval.
    fn at(&self, part: f64) -> Moment {
        let [a, b] = self.times;
        Moment {
            frame: a.frame + part * (b.frame - a.frame),
            seconds: a.seconds + part * (b.seconds - a.seconds),
        }
    }

    /// Returns where points should be, and how far from there they are, in pixels.
    fn offsets<P: Path<Key = K>>(&self, path: &P, part: f64) -> Vec<Option<DVec2>> {
        let moment = self.at(part);
        let right = path.pixels(&path.key(moment), moment);
        let mixed = path.pixels(&path.mix(self.keys, part), moment);
        let pairs = right.into_iter().zip(mixed);
        pairs.map(|(right, mixed)| Some(mixed? - right?)).collect()
    }

    /// Returns the farthest that a point strays, in pixels.
    fn stray<P: Path<Key = K>>(&self, path: &P) -> f64 {
        let offsets = [0.25, 0.5, 0.75].map(|part| self.offsets(path, part));
        let lengths = offsets
            .iter()
            .flatten()
            .flatten()
            .map(|offset| offset.length());
        lengths.fold(0.0, f64::max)
    }

    /// Returns whether velocities are right at the ends at which frames are drawn. The offset is 0
    /// there, so its slope is that of a parabola through two more points.
    fn is_velocity_right<P: Path<Key = K>>(&self, path: &P, tolerance: Tolerance) -> bool {
        const STEP: f64 = 1.0 / 16.0;
        let length = STEP * (self.times[1].frame - self.times[0].frame);
        let is_right = |parts: [f64; 2]| {
            let [near, far] = parts.map(|part| self.offsets(path, part));
            let mut slopes = near.iter().zip(&far).filter_map(|(near, far)| {
                let slope = (4.0 * (*near)? - (*far)?) / (2.0 * length);
                Some(slope.length())
            });
            slopes.all(|slope| slope <= tolerance.velocity)
        };
        let [start, end] = self.is_drawn;
        (!start || is_right([STEP, 2.0 * STEP]))
            && (!end || is_right([1.0 - STEP, 1.0 - 2.0 * STEP]))
    }
}
