//! A scene at later frames of its own clock, and at other frame rates than its file's.

use glam::DVec3;

use crate::frame_rate::FrameRate;
use crate::model::{Motion, Scene};

/// A time at which the scene is not defined, of a later frame or at another frame rate than its
/// file's.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "scene {scene}: needs {what} at frame {time}, and the keys {edge}; allowed: motions of two keys, which go on steadily, and \
     others from their first key or shape to their last; take fewer frames, a higher frame rate or a shorter shutter, leave the \
     scene out, or give it more keys"
)]
pub struct UndefinedTime {
    /// The scene's name, with the frame rate and the frame.
    pub scene: String,
    /// What is not defined.
    pub what: String,
    /// Where the keys begin or end: `end at frame 3`.
    pub edge: String,
    /// Time that was asked for, in frames.
    pub time: f64,
}

impl Scene {
    /// Makes the scene as it is `frame` frames later: that time becomes time 0 of the result, for
    /// which frame and truth are rendered. All keys and key shapes move; the settings, the seed and
    /// everything without keys stay. The result has an identity and a hash of its own. Frame 0 is
    /// the scene itself.
    ///
    /// Renders of a later frame refuse times at which the scene is not defined; see
    /// [`UndefinedTime`].
    pub fn at_frame(&self, frame: u32) -> Self {
        assert_eq!(self.id.frame, 0, "frames are counted from the scene's own");
        if frame == 0 {
            return self.clone();
        }
        let mut scene = self.clone().later_by(f64::from(frame));
        scene.id.frame = frame;
        let text = format!("{} at frame {frame}", self.hash);
        scene.hash = blake3::hash(text.as_bytes()).to_hex().to_string();
        scene
    }

    /// Makes the scene as it is some frames later, or earlier if `later` is negative. Its identity
    /// and its hash stay, so nothing made from it may be stored in files.
    pub fn later_by(mut self, later: f64) -> Self {
        self.change_times(|time| time - later);
        self
    }

    /// Converts the scene to another frame rate. All times in its file, and the delay of a rolling
    /// shutter, stay the same in seconds. The instant stays. The caller sets identity and hash.
    pub(crate) fn at_rate(mut self, rate: FrameRate) -> Self {
        let frames = rate.frames_per_written_frame();
        self.change_times(|time| time * frames);
        self.shutter_profile.rolling *= frames;
        self.exposure = rate.exposure(self.exposure);
        self
    }

    /// Refuses times at which the scene is not defined, `open` to `close` in frames after the
    /// instant: for a later frame those beyond the end of its keys, and at another frame rate those
    /// before their beginning as well.
    pub fn check_defined(&self, open: f64, close: f64) -> Result<(), UndefinedTime> {
        let is_own_rate = self.rate() == FrameRate::WRITTEN;
        if is_own_rate && self.id.frame == 0 {
            return Ok(());
        }
        let refuse = |what: String, time: f64, edge: String| {
            Err(UndefinedTime {
                scene: self.id.to_string(),
                what,
                edge,
                time,
            })
        };
        let frame = f64::from(self.id.frame);
        let ends = |last: f64| format!("end at frame {}", last + frame);
        for (what, first, last) in self.list_timelines() {
            if !is_own_rate && first > open {
                return refuse(
                    what,
                    open,
                    format!("begin at frame {first} of this frame rate"),
                );
            }
            if last < close {
                return refuse(what, close + frame, ends(last));
            }
        }
        for (what, motion) in self.named_motions() {
            if let Some(last) = end_of_scale(motion, close) {
                return refuse(format!("the scale of {what}"), close + frame, ends(last));
            }
        }
        Ok(())
    }

    /// Lists paths and key shapes, which are defined from their first key or shape to their last,
    /// with the times of both. Steady motions go on for ever.
    fn list_timelines(&self) -> Vec<(String, f64, f64)> {
        let motions = (self.named_motions().into_iter()).map(|(what, motion)| {
            let times = motion.keys.iter().map(|key| key.time).collect();
            (format!("the motion of {what}"), STEADY_KEYS, times)
        });
        let views = self.camera.vertical_fov.iter().map(|(time, _)| *time);
        let view = "the camera's field of view".to_owned();
        let shapes = self.objects.iter().map(|object| {
            let what = format!("the shapes of object {}", object.name);
            (what, 0, self.meshes[object.mesh].shape_times().collect())
        });
        (motions.chain([(view, STEADY_KEYS, views.collect())]))
            .chain(shapes)
            .filter(|(_, most, times): &(_, _, Vec<f64>)| times.len() > *most)
            .map(|(what, _, times)| (what, times[0], times[times.len() - 1]))
            .collect()
    }

    /// Lists all motions, each with its name for messages.
    fn named_motions(&self) -> Vec<(String, &Motion)> {
        let objects = self.objects.iter().map(|object| {
            let name = format!("object {}", object.name);
            (name, &object.motion)
        });
        let camera = ("the camera".to_owned(), &self.camera.motion);
        objects.chain([camera]).collect()
    }
}

/// Keys that make a steady motion, which goes on for ever. More of them make a path, which ends at
/// the last.
const STEADY_KEYS: usize = 2;

/// Finds the last key of a motion whose scale passes 0 between that key and `time`; none if it
/// keeps its sign.
fn end_of_scale(motion: &Motion, time: f64) -> Option<f64> {
    let last = motion.keys.last()?;
    let segment = motion.segment(time.max(last.time));
    let scale: DVec3 = segment.scale.at(segment.since(time.max(last.time)));
    ((last.scale * scale).min_element() <= 0.0).then_some(last.time)
}

#[cfg(test)]
mod tests {
    use crate::test_scene::load_test_scene;

    /// Compares two poses. Coordinates of some 100 m are rounded to 1e-14 of their size.
    fn assert_same(pose: glam::DAffine3, expected: glam::DAffine3, what: &str) {
        assert!(
            pose.abs_diff_eq(expected, 1e-9),
            "{what}: {pose} {expected}"
        );
    }

    #[test]
    fn a_later_frame_shows_what_happens_later() {
        let scenes = ["fan", "walker", "dolly", "flag", "reversal", "ramp_floor"];
        for name in scenes {
            let scene = load_test_scene(name);
            for frame in [1, 2, 7] {
                let later = scene.at_frame(frame);
                for time in [-1.0, -0.3, 0.0, 0.2] {
                    let then = time + f64::from(frame);
                    for object in 0..scene.objects.len() {
                        let [pose, expected] = [(&later, time), (&scene, then)]
                            .map(|(scene, time)| scene.object_to_world(object, time));
                        assert_same(pose, expected, name);
                    }
                    let [pose, expected] = [(&later, time), (&scene, then)]
                        .map(|(scene, time)| scene.camera.motion.at(time));
                    assert_same(pose, expected, name);
                    let [angle, expected] = [(&later, time), (&scene, then)]
                        .map(|(scene, time)| scene.camera.vertical_fov_at(time));
                    assert!((angle - expected).abs() < 1e-12);
                    for (mesh, expected) in later.meshes.iter().zip(&scene.meshes) {
                        let [point, expected] = [(mesh, time), (expected, then)]
                            .map(|(mesh, time)| mesh.at(time).positions().next().unwrap());
                        assert!(point.distance(expected) < 1e-9, "{name}");
                    }
                }
                assert_ne!(later.hash, scene.hash);
                assert_eq!(later.id.to_string(), format!("{name}/{frame:04}"));
            }
        }
    }
}
