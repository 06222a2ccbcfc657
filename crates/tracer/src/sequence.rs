//! A scene at later frames of its own clock.

use glam::DVec3;

use crate::error::TraceError;
use crate::motion::keys::Motion;
use crate::scene::{Mesh, Scene};

impl Scene {
    /// Makes the scene as it is `frame` frames later: what happens at that time happens at time 0 of the result, of which
    /// frame and truth are rendered. All keys and key shapes move; the settings, the seed and everything without keys stay.
    /// The result has a name and a hash of its own. Frame 0 is the scene itself.
    ///
    /// Renders of a later frame refuse times at which the scene is not defined; see [`TraceError::Undefined`].
    pub fn at_frame(&self, frame: u32) -> Self {
        assert_eq!(self.frame, 0, "frames are counted from the scene's own");
        let mut scene = self.clone();
        if frame == 0 {
            return scene;
        }
        let later = f64::from(frame);
        let objects = scene.objects.iter_mut().map(|object| &mut object.motion);
        for motion in objects.chain([&mut scene.camera.motion]) {
            for key in &mut motion.keys {
                key.time -= later;
            }
        }
        for (time, _) in &mut scene.camera.vertical_fov {
            *time -= later;
        }
        for shape in scene.meshes.iter_mut().flat_map(|mesh| &mut mesh.shapes) {
            shape.time -= later;
        }
        scene.frame = frame;
        scene.name = format!("{}/{frame:04}", self.name);
        let text = format!("{} at frame {frame}", self.hash);
        scene.hash = blake3::hash(text.as_bytes()).to_hex().to_string();
        scene
    }

    /// Refuses a time of a later frame at which the scene is not defined. `time` is in frames after that frame's instant.
    pub(crate) fn check_defined(&self, time: f64) -> Result<(), TraceError> {
        if self.frame == 0 {
            return Ok(());
        }
        let refuse = |what: String, last: f64| TraceError::Undefined {
            scene: self.name.clone(),
            what,
            last: last + f64::from(self.frame),
            time: time + f64::from(self.frame),
        };
        let camera = ("the camera".to_owned(), &self.camera.motion);
        let objects = self.objects.iter().map(|object| {
            let name = format!("object {}", object.name);
            (name, &object.motion)
        });
        for (what, motion) in objects.chain([camera]) {
            if let Some(last) = end_of_path(motion).filter(|last| *last < time) {
                return Err(refuse(format!("the motion of {what}"), last));
            }
            if let Some(last) = end_of_scale(motion, time) {
                return Err(refuse(format!("the scale of {what}"), last));
            }
        }
        if let [.., (last, _)] = self.camera.vertical_fov[..]
            && self.camera.vertical_fov.len() > STEADY_KEYS
            && last < time
        {
            return Err(refuse("the camera's field of view".to_owned(), last));
        }
        for object in &self.objects {
            if let Some(last) = end_of_shapes(&self.meshes[object.mesh])
                && last < time
            {
                return Err(refuse(
                    format!("the shapes of object {}", object.name),
                    last,
                ));
            }
        }
        Ok(())
    }
}

/// Keys that make a steady motion, which goes on for ever. More of them make a path, which ends at the last.
const STEADY_KEYS: usize = 2;

/// Finds the time at which a motion's path ends; none where it stands still or is steady.
fn end_of_path(motion: &Motion) -> Option<f64> {
    let keys = &motion.keys;
    let is_path = keys.len() > STEADY_KEYS;
    keys.last().filter(|_| is_path).map(|key| key.time)
}

/// Finds the last key of a motion whose scale passes 0 between that key and `time`; none where it keeps its sign.
fn end_of_scale(motion: &Motion, time: f64) -> Option<f64> {
    let last = motion.keys.last()?;
    let segment = motion.segment(time.max(last.time));
    let scale: DVec3 = segment.scale.at(segment.since(time.max(last.time)));
    ((last.scale * scale).min_element() <= 0.0).then_some(last.time)
}

/// Finds the time of the last key shape; none of a rigid mesh.
fn end_of_shapes(mesh: &Mesh) -> Option<f64> {
    mesh.shapes.last().map(|shape| shape.time)
}
