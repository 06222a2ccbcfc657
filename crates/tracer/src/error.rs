//! Reasons why nothing is rendered.

use frame::ShutterError;
use scene::{SizeError, UndefinedTime};

use crate::limits::{LARGEST_COORDINATE, LARGEST_VALUE, MAX_SAMPLES};

/// A refusal to render, or the end of a render.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TraceError {
    /// The watcher asked to stop.
    #[error("rendering was cancelled")]
    Cancelled,
    /// A picture of no pixels, or of too many.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// An impossible exposure.
    #[error(transparent)]
    Shutter(#[from] ShutterError),
    /// Replicates that cannot be halved, or too few to have a spread.
    #[error("replicates is {0}; allowed: even numbers from 2, such as 8")]
    Replicates(u32),
    /// Samples that give replicates no equal number, or too many.
    #[error(
        "samples per pixel is {samples_per_pixel} over {replicates} replicates; allowed: {replicates} times a \
         number up to {MAX_SAMPLES}, such as {nearest}"
    )]
    Samples {
        /// Samples asked for.
        samples_per_pixel: u32,
        /// Replicates that share them.
        replicates: u32,
        /// Nearest allowed number.
        nearest: u32,
    },
    /// Sub-frames of a ladder that do not rise from 1.
    #[error("sub-frames are {0:?}; allowed: rising whole numbers from 1, such as 1, 2, 4")]
    Subframes(Vec<u32>),
    /// An object too far away, or too large.
    #[error(
        "scene {scene}: object {object} reaches {coordinate:e} m from the origin at some time that is rendered; allowed: \
         {LARGEST_COORDINATE:e} m; check its vertices, scale and keys, and those of its parents"
    )]
    TooFar {
        /// The scene's name.
        scene: String,
        /// The object's name.
        object: String,
        /// Greatest coordinate, in metres; may be infinite.
        coordinate: f64,
    },
    /// A pixel that is not a finite number, or is too large.
    #[error(
        "scene {scene}: {layer} is {value:e} at ({x}, {y}); allowed: finite numbers up to {LARGEST_VALUE:e}; lower the emission, \
         the background or the sun that is seen there, or widen the sun"
    )]
    NotFinite {
        /// The scene's name.
        scene: String,
        /// Name of the rendered layer in its file.
        layer: String,
        /// The value found.
        value: f32,
        /// Column, from 0 on the left.
        x: u32,
        /// Row, from 0 at the top.
        y: u32,
    },
    /// A field of view that is impossible at some time.
    #[error(
        "scene {scene}: the camera's vertical field of view is {degrees:.3} degrees at time {time} frames; allowed: \
         above 0 and below 180 at every time that is rendered; its keys go on beyond the first and last"
    )]
    FieldOfView {
        /// The scene's name.
        scene: String,
        /// Field of view, in degrees.
        degrees: f64,
        /// Time, in frames.
        time: f64,
    },
    /// A time at which the scene is not defined.
    #[error(transparent)]
    Undefined(#[from] UndefinedTime),
}
