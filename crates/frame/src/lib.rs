//! Images, the frame of an instant, the truth of a shutter interval, and their files: all that the
//! tracer hands to filters and metrics.
//!
//! # The contract
//!
//! Every crate of the project keeps to these conventions. They are stated only here.
//!
//! | thing | convention |
//! |---|---|
//! | world | right-handed, +Y up, metres; a camera looks along its own -Z |
//! | image | row-major from the top left; pixel (i, j) covers `[i, i+1) x [j, j+1)`; its centre is at +0.5 |
//! | colour | scene-linear Rec.709 radiance, `f32`; the display transform is applied only for PNG and LDR metrics |
//! | pixel filter | box of one pixel for colour and coverage; velocity, depth and object id are point samples at the pixel centre |
//! | time | in frames; the frame's instant is `t = 0` |
//! | shutter | [`Shutter`]`{ open, close }`, frames relative to the instant. Exposure `m = close - open`, 1 being 360 degrees. Trailing is `[-m, 0]`, centred `[-m/2, m/2]`, leading `[0, m]`. The frame never moves; the truth's interval does. [`ShutterProfile`] says how it opens and closes within the interval, and when each row is exposed |
//! | velocity | screen motion of the surface point seen at the pixel centre over one frame interval, in pixels, +x right, +y down; see [`VelocityKind`]. A background at infinity has the camera's rotational velocity |
//! | further velocities | only where a filter asks for them: `velocity_next`, the motion from the instant to one frame later, and `velocity_z`, the change of depth in metres per frame over the interval of `velocity`, positive away from the camera |
//! | depth | distance along the view axis in metres; the background holds [`FAR_DEPTH`] |
//! | coverage | per object: the fraction of (shutter x pixel area) in which that object is the visible surface; sums to 1 with the background. A translucent surface counts by the share of the light that it stops or reflects |
//! | lens | a camera may have one. Colour and coverage of frames, and all of a truth, are then means over the points of its disc; velocity, depth and object id belong to a pinhole at its centre. A truth's state at the instant is seen from the same point of the lens, so that it shows motion alone |
//! | translucent surfaces | in colour and coverage; velocity, depth and object id come from the first opaque surface behind them, unless their material says otherwise |
//! | noise | a truth is R independent, complete replicates; its file has two halves A and B and the standard error. Colour and coverage of a frame are the mean of as many. Replicate r of both has the same random numbers, so that what stands still is equal in both; nothing else in a frame has noise |
//! | support | the pixels where the open shutter sees an object at all: a function of scene, shutter and size, which the noise of a truth does not change; see [`Support`] |
//! | determinism | the same inputs give the same bytes on any number of threads |

mod accumulation;
mod at_instant;
mod camera;
mod display;
mod exr;
mod file;
mod frame;
mod frame_options;
mod hidden;
mod photo;
mod picture;
mod png;
mod provenance;
mod raster;
mod region;
mod replicate;
mod reprojection;
mod sheet;
mod shutter;
mod size;
mod support;
mod tile;
mod traced_frame;
mod truth;
mod words;

pub use accumulation::{Accumulation, Ladder, MOST_GROUPS, rung_file};
pub use at_instant::AtInstant;
pub use camera::{Camera, CameraPose};
pub use display::{
    Display, FlipExposures, MAX_STOPS, decode_srgb, display_srgb, luminance, scene_linear,
};
pub use exr::{
    Channel, ColorMeaning, ExrClaims, ExrFile, LARGEST_EXR_RATIO, LARGEST_EXR_SIDE, MAX_EXR_BYTES,
    MAX_EXR_CHANNELS, Samples, decode_exr, read_attribute, read_exr, read_exr_claims,
    read_exr_header, read_passes, write_exr, write_half_exr, write_small_exr,
};
pub use file::{
    FileError, open_regular, read_bounded, remove_leftovers, write_atomically, write_streamed,
};
pub use frame::{FAR_DEPTH, Frame, read_frame_rate};
pub use frame_options::{ColorSampling, FrameOptions, VelocityKind};
pub use hidden::is_hidden;
pub use photo::{MAX_PICTURE_PIXELS, read_hdr, read_jpeg, read_png_bits};
pub use picture::Picture;
pub use png::{check_png_palette, png_bytes, read_png, write_animated_png, write_jpeg, write_png};
pub use provenance::Provenance;
pub use raster::{Image, Plane, Raster, Vectors, find_broken};
pub use region::{Region, Regions};
pub use replicate::Replicate;
pub use reprojection::Reprojection;
pub use sheet::tile_pictures;
pub use shutter::{
    Alignment, Efficiency, LONGEST_EXPOSURE, SHORTEST_EXPOSURE, Shutter, ShutterError,
    ShutterProfile,
};
pub use size::Size;
pub use support::Support;
pub use tile::Tile;
pub use traced_frame::{TracedFrame, read_frame_replicates};
pub use truth::{
    FLIP_REACH, Truth, TruthError, motion_margin, moving_region, regions, shaded_region, truth_hash,
};
