//! Errors of colour: their maps, and what is pooled from these.

pub mod absolute_error;
pub mod convolution;
pub mod cross_error;
pub mod error_maps;
pub mod flip;
pub mod frozen;
pub mod pooled;
pub mod pooled_scores;
pub mod pooling;
pub mod ssim;
