//! Jitter of the camera, as for temporal anti-aliasing. Velocity and depth belong to the shifted
//! pixels.

use frame::{Frame, Vectors};
use tracer::{PixelGrid, PointMotion, trace_motion_on};

use super::renderer::Renderer;
use crate::render::settings::settings_of;
use crate::{Error, named};

/// Number of jitters before they repeat.
const PHASES: u32 = 8;

named! {
    /// Jitter of the camera, as temporal anti-aliasing has it.
    pub enum CameraJitter {
        /// No jitter.
        None = "none",
        /// A jittered frame; the jitter is taken out of the vectors.
        Removed = "removed",
        /// A jittered frame; the jitter is left in the vectors.
        LeftIn = "left_in",
        /// The colour without jitter, as after anti-aliasing; depth and vectors of the jittered
        /// frame, without jitter in the vectors.
        Resolved = "resolved",
    }
}

impl CameraJitter {
    /// Returns the frame of a jittered camera.
    pub(crate) fn apply(self, frame: Frame, renderer: &Renderer) -> Result<Frame, Error> {
        let index = renderer.scene.id.frame;
        let settings = settings_of(&frame);
        let grid = PixelGrid {
            size: settings.size(),
            // A picture that moves right is sampled further left.
            offset: jitter(index).map(|part| -part),
        };
        let render = || renderer.frame("jittered frame", &settings, &grid);
        match self {
            Self::None => Ok(frame),
            Self::Removed => render(),
            Self::LeftIn => {
                let jittered = render()?;
                let add = |velocity, motion| add_motion(&jittered, velocity, motion);
                let next = jittered.velocity_next.as_ref();
                let velocity_next = next.map(|next| add(next, jitter_motion(index + 1)));
                Ok(Frame {
                    velocity: add(&jittered.velocity, jitter_motion(index)),
                    velocity_next,
                    ..jittered
                })
            }
            Self::Resolved => {
                let motion = &PointMotion::RIGHT;
                let points = trace_motion_on(renderer.scene, &settings, motion, &grid)?;
                let resolved = Frame {
                    velocity: points.velocity,
                    velocity_next: None,
                    velocity_z: None,
                    depth: points.depth,
                    object_id: points.object_id,
                    ..frame
                };
                renderer.complete(resolved, &settings, &grid)
            }
        }
    }
}

/// Adds a motion of the whole picture to all vectors, except those of a background without
/// velocity.
fn add_motion(frame: &Frame, velocity: &Vectors, motion: [f32; 2]) -> Vectors {
    velocity.zip(&frame.object_id, |velocity, object| {
        if *object == 0 && !frame.options.sky_velocity {
            *velocity
        } else {
            [0, 1].map(|axis| velocity[axis] + motion[axis])
        }
    })
}

/// Returns how far jitter moves a frame's picture from the previous frame's, in pixels.
pub(super) fn jitter_motion(frame: u32) -> [f32; 2] {
    let before = (frame + PHASES - 1) % PHASES;
    let [before, now] = [before, frame].map(jitter);
    [0, 1].map(|axis| (now[axis] - before[axis]) as f32)
}

/// Returns how far jitter moves a frame's picture, in pixels; +x right, +y down. Frame 0 has the
/// second jitter.
fn jitter(frame: u32) -> [f64; 2] {
    let point = (frame + 1) % PHASES + 1;
    [2, 3].map(|base| halton(point, base) - 0.5)
}

/// Returns a number of the Halton sequence, counted from 1: the digits of its index in a base,
/// mirrored at the point.
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
        let expected = [
            [1.0 / 4.0, 2.0 / 3.0],
            [3.0 / 4.0, 1.0 / 9.0],
            [1.0 / 8.0, 4.0 / 9.0],
        ];
        for (frame, expected) in (0..).zip(expected) {
            for (offset, expected) in jitter(frame).iter().zip(expected) {
                assert!((offset + 0.5 - expected).abs() < 1e-12, "{frame}: {offset}");
            }
        }
        assert_eq!(jitter(3), jitter(3 + PHASES));
        assert_eq!(jitter_motion(0), jitter_motion(PHASES));
        // The velocity defect `jittered`.
        assert_eq!(jitter_motion(0), [-0.25, 1.0 / 3.0]);
    }
}
