//! Frames, truths and ladders of scenes, rendered once and kept as files.

pub mod layers;
pub mod memory;
pub mod merge;
pub mod rendered;
pub mod replicates;
pub mod scatter_oracle;
