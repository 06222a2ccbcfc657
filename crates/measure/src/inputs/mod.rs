//! Forms of the frames that filters get: formats, sizes and defects of the buffers, and sampling of
//! the frame.

pub mod border;
pub mod buffer_size;
pub mod camera_jitter;
pub mod depth_format;
pub mod depth_of_field;
pub mod input_format;
pub mod multisampling;
pub mod render_scale;
mod renderer;
mod resample;
pub mod shutter_rule;
#[cfg(test)]
mod test_frame;
pub mod velocity_defect;
pub mod velocity_format;
