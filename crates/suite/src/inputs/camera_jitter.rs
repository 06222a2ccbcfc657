//! Jitter of the camera, as temporal anti-aliasing has it.

use frame::{Frame, Vectors};
use tracer::{PixelGrid, PointMotion, Scene, trace_frame_part, trace_motion_on};

use crate::inputs::traced_again::settings_of;
use crate::{Error, Monitor, named};

/// Number of jitters before they repeat.
const PHASES: u32 = 8;

named! {
    /// What a jittered camera leaves in the frame. Velocity and depth are those of the moved pixels.
    pub enum CameraJitter {
        /// No jitter.
        None = "none",
        /// A jittered frame; the jitter is taken out of the vectors.
        Removed = "removed",
        /// A jittered frame; the jitter is left in the vectors.
        LeftIn = "left_in",
        /// The colour without jitter, as after anti-aliasing; depth and vectors of the jittered frame, without jitter in the vectors.
        Resolved = "resolved",
    }
}

impl CameraJitter {
    /// Returns the frame of a jittered camera.
    ///
    /// # Errors
    /// The scene cannot be rendered so, or the monitor interrupts.
    pub(crate) fn apply(
        self,
        frame: &Frame,
        scene: &Scene,
        monitor: Monitor,
    ) -> Result<Frame, Error> {
        if self == Self::None {
            return Ok(frame.clone());
        }
        let [before, now] = jitters(scene.id.frame);
        let settings = settings_of(frame);
        let grid = PixelGrid {
            size: [settings.width, settings.height],
            // What moves to the right in the picture lies further to the left for the pixels.
            offset: now.map(|part| -part),
        };
        if self == Self::Resolved {
            let points = trace_motion_on(scene, &settings, &PointMotion::RIGHT, &grid)?;
            return Ok(Frame {
                velocity: points.velocity,
                depth: points.depth,
                object_id: points.object_id,
                ..frame.clone()
            });
        }
        let label = format!("{} jittered frame", scene.id);
        let jittered = monitor.watch(&label, |watch| {
            trace_frame_part(scene, &settings, &grid, None, watch)
        })?;
        let velocity = match self {
            Self::LeftIn => add_jitter(&jittered, [0, 1].map(|axis| now[axis] - before[axis])),
            _ => jittered.velocity,
        };
        Ok(Frame {
            velocity,
            ..jittered
        })
    }
}

/// Adds a motion of the whole picture to all vectors, but to none of a background that has no velocity.
fn add_jitter(frame: &Frame, motion: [f64; 2]) -> Vectors {
    frame.velocity.zip(&frame.object_id, |velocity, object| {
        match *object == 0 && !frame.options.sky_velocity {
            true => *velocity,
            false => [0, 1].map(|axis| velocity[axis] + motion[axis] as f32),
        }
    })
}

/// Returns by how much the jitter moves the picture in the frame before and in this one, in pixels; +x right, +y down. The frame
/// 0 is the second of the sequence, as in the velocity defect `jittered`.
pub(crate) fn jitters(frame: u32) -> [[f64; 2]; 2] {
    [frame, frame + 1].map(|index| {
        let point = index % PHASES + 1;
        [halton(point, 2) - 0.5, halton(point, 3) - 0.5]
    })
}

/// Returns a number of the Halton sequence, counted from 1: the digits of its index in a base, mirrored at the point.
fn halton(mut index: u32, base: u32) -> f64 {
    let mut part = 1.0;
    let mut number = 0.0;
    while index > 0 {
        part /= f64::from(base);
        number += part * f64::from(index % base);
        index /= base;
    }
    number
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jitters_are_the_halton_sequence_and_repeat() {
        let sequence = [1, 2, 3, 4].map(|index| [halton(index, 2), halton(index, 3)]);
        let expected = [
            [1.0 / 2.0, 1.0 / 3.0],
            [1.0 / 4.0, 2.0 / 3.0],
            [3.0 / 4.0, 1.0 / 9.0],
            [1.0 / 8.0, 4.0 / 9.0],
        ];
        for (found, expected) in sequence.as_flattened().iter().zip(expected.as_flattened()) {
            assert!((found - expected).abs() < 1e-12, "{sequence:?}");
        }
        assert_eq!(jitters(0)[1], jitters(1)[0]);
        assert_eq!(jitters(3), jitters(3 + PHASES));
        assert_ne!(jitters(3), jitters(2 + PHASES));
        let [before, now] = jitters(0);
        // The velocity defect `jittered` has the same motion.
        assert!((now[0] - before[0] + 0.25).abs() < 1e-12);
        assert!((now[1] - before[1] - 1.0 / 3.0).abs() < 1e-12);
    }
}
