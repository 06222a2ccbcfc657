//! Means, convolutions and conversions that several rooms share.

pub mod conversion;
pub mod convolution;
pub mod pooling;
