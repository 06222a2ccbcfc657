//! A CPU path tracer: from a scene of moving meshes to the frame of one instant and the truth
//! of a shutter interval.
//!
//! It follows the conventions of the [`frame`] crate.

mod accel;
mod aligned_shutter;
mod coincident;
mod content_hash;
mod defocus;
mod error;
mod film;
mod hit;
mod instant;
mod ladder;
mod light;
pub mod limits;
mod material;
mod motion;
mod path;
mod pixel_grid;
mod progress;
mod sampler;
mod settings;
mod stage;
#[cfg(test)]
mod test_scene;
mod truth;

pub use bvh::Ray;
pub use coincident::find_coincident_surfaces;
pub use content_hash::{frame_hash, ladder_hash, replicate_hash, truth_hash};
pub use defocus::{Defocus, trace_defocus};
pub use error::TraceError;
pub use hit::Hit;
pub use instant::{
    PointLayers, trace_frame, trace_frame_part, trace_further_velocities, trace_motion,
    trace_motion_on,
};
pub use ladder::{LadderTracer, trace_ladder};
pub use limits::MAX_SAMPLES;
pub use motion::point_motion::{ObjectsBefore, PointMotion};
pub use motion::poses::Poses;
pub use motion::view::View;
pub use pixel_grid::PixelGrid;
pub use progress::{Progress, Watch};
pub use settings::{RenderSettings, check_next_frame};
pub use stage::Stage;
pub use truth::{TruthTracer, trace_truth};
