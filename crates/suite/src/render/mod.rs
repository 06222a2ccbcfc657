//! Frames, truths and ladders of scenes, rendered once and kept as files.

pub mod frames;
pub mod kept;
pub mod ladders;
pub mod memory;
pub mod merge;
pub mod replicates;
pub mod scatter_oracle;
pub mod settings;
pub mod shared;
pub mod truths;
