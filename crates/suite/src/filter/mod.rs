//! Filters with their parameters, the forms of their input, and their runs.

pub mod border;
pub mod buffer_size;
pub mod camera_jitter;
pub mod choice;
pub mod depth_format;
pub mod depth_of_field;
pub mod input_format;
pub mod multisampling;
pub mod render_scale;
mod resample;
pub mod runner;
pub mod shutter_rule;
#[cfg(test)]
mod test_frame;
mod traced_again;
pub mod unorm;
pub mod velocity_defect;
pub mod velocity_format;
