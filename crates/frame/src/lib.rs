//! What the tracer hands to the filters and the metrics: images, the frame of an instant, the truth of a shutter
//! interval, and their files.
//!
//! # The contract
//!
//! Every crate of the project keeps to these conventions, and nothing states them again.
//!
//! | thing | convention |
//! |---|---|
//! | world | right-handed, +Y up, metres; a camera looks along its own -Z |
//! | image | row-major from the top left; pixel (i, j) covers `[i, i+1) x [j, j+1)`; its centre is at +0.5 |
//! | colour | scene-linear Rec.709 radiance, `f32`; the display transform is applied only for PNG and LDR metrics |
//! | pixel filter | box of one pixel for colour and coverage; velocity, depth and object id are point samples at the pixel centre |
//! | time | in frames; the frame's instant is `t = 0` |
//! | shutter | [`Shutter`]`{ open, close }`, frames relative to the instant. Exposure `m = close - open`, 1 being 360 degrees. Trailing is `[-m, 0]`, centred `[-m/2, m/2]`, leading `[0, m]`. The frame never moves; the truth's interval does. [`ShutterProfile`] says how it opens and closes within the interval, and how rows follow one another |
//! | velocity | screen motion of the surface point seen at the pixel centre over one frame interval, in pixels, +x right, +y down; see [`VelocityKind`]. A background at infinity has the camera's rotational velocity |
//! | depth | distance along the view axis in metres; the background holds [`FAR_DEPTH`] |
//! | coverage | per object: the fraction of (shutter x pixel area) in which that object is the visible surface; sums to 1 with the background |
//! | noise | a truth is R independent, complete replicates; two halves A and B and the standard error travel with it |
//! | support | what the open shutter sees at all: a function of scene, shutter and size, which no noise of a truth changes; see [`Support`] |
//! | determinism | the same inputs give the same bytes on any number of threads |

mod accumulation;
mod at_instant;
mod atomic;
mod bounded;
mod checksum;
mod display;
mod error;
mod exr_file;
mod exr_header;
mod exr_reading;
mod exr_text;
mod hidden;
mod instant;
mod picture;
mod png_palette;
mod provenance;
mod raster;
mod region;
mod replicate;
mod reprojection;
mod shutter;
mod shutter_profile;
mod support;
mod truth;

pub use accumulation::{Accumulation, Ladder};
pub use at_instant::AtInstant;
pub use atomic::{remove_leftovers, write_atomically};
pub use bounded::read_bounded;
pub use display::{
    Display, FlipExposures, MOST_PNG_PIXELS, MOST_STOPS, display_srgb, read_png, scene_linear,
    write_png,
};
pub use error::FileError;
pub use exr_file::{Channel, ExrFile, Samples, write_exr};
pub use exr_header::{LARGEST_EXR_RATIO, LARGEST_EXR_SIDE, MOST_EXR_BYTES, MOST_EXR_CHANNELS};
pub use exr_reading::read_exr;
pub use hidden::is_hidden;
pub use instant::{ColorSampling, FAR_DEPTH, Frame, VelocityKind};
pub use picture::Picture;
pub use png_palette::check_png_palette;
pub use provenance::Provenance;
pub use raster::{Image, Plane, Raster, Vectors};
pub use region::{Region, Regions, regions};
pub use replicate::Replicate;
pub use reprojection::Reprojection;
pub use shutter::{Alignment, LONGEST_EXPOSURE, SHORTEST_EXPOSURE, Shutter, ShutterError};
pub use shutter_profile::{Efficiency, ShutterProfile};
pub use support::Support;
pub use truth::{Truth, TruthError, truth_hash};
