//! Captures: an engine's pictures of one instant, and of the shutter around it, in a folder of
//! files.

pub mod buffers;
pub mod description;
pub mod folder;
pub mod half_floats;
mod raw;
