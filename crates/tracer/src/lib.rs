//! A CPU path tracer: from a scene of moving OBJ meshes to the frame of one instant and the truth
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
mod frame_rate;
mod hit;
mod instant;
mod ladder;
mod light;
pub mod limits;
mod load;
mod location;
mod material;
mod motion;
mod path;
mod pixel_grid;
mod progress;
mod sampler;
mod scene;
mod scene_id;
mod seal;
mod sequence;
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
pub use frame_rate::FrameRate;
pub use hit::Hit;
pub use instant::{
    PointLayers, trace_frame, trace_frame_part, trace_further_velocities, trace_motion,
    trace_motion_on,
};
pub use ladder::{LadderTracer, trace_ladder};
pub use limits::MAX_SAMPLES;
pub use load::{
    SceneError, SceneListing, list_scene, list_scenes, load_scene, load_scene_and_files,
};
pub use location::{Bundle, Location};
pub use motion::camera::View;
pub use motion::point_motion::{ObjectsBefore, PointMotion};
pub use motion::poses::Poses;
pub use pixel_grid::PixelGrid;
pub use progress::{Progress, Watch};
pub use scene::{
    Background, Camera, Display, EnvironmentMap, Family, Finish, FlipExposures, Interpolation, Key,
    Lens, Material, Mesh, Motion, Object, Parent, Scene, Shape, Sun, Texture, Translucency, Turn,
};
pub use scene_id::SceneId;
pub use seal::Seal;
pub use settings::{RenderSettings, check_next_frame};
pub use stage::Stage;
pub use truth::{TruthTracer, trace_truth};
