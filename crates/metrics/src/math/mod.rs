//! Means, convolutions, powers and rasters that several modules share.

pub mod convolution;
pub mod lines;
pub mod pooling;
pub mod power;
pub mod raster;
