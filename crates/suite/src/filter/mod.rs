//! Filters with their parameters, the forms of their input, and their runs.

pub mod border;
pub mod choice;
pub mod depth_format;
pub mod input_format;
pub mod runner;
pub mod unorm;
pub mod velocity_defect;
pub mod velocity_format;
