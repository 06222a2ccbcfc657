//! Errors of colour.

pub mod absolute_error;
pub mod cross_error;
pub mod flip;
pub mod grain;
pub mod ssim;
