//! The main job: renders every scene, runs every filter on it, and measures each picture's distance
//! from the truth.

mod attempt;
pub mod case;
mod check_plan;
pub mod dilated_velocity;
pub mod earlier;
pub mod estimate;
mod frames;
pub mod measured_filters;
mod missing_cases;
pub mod needed_samples;
pub mod part;
pub mod pictures;
pub mod plan;
pub mod planned_case;
pub(crate) mod points_of_frame;
pub mod probes;
pub mod references;
pub mod scene;
mod scene_keys;
pub mod scenes;
pub mod sequence;
mod stored_frames;
