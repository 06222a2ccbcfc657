//! Frames, truths and ladders of scenes, each rendered once and then read back from its file.

pub mod exclusion;
pub mod files;
pub mod in_memory;
pub mod ingested_scene;
pub mod ladders;
pub mod memory;
pub mod rendering;
pub mod replicates;
pub mod run_scene;
pub mod settings;
pub mod truths;
pub mod velocities;
