//! Arguments that commands share.

pub mod adapter;
pub mod candidate;
pub mod frame_rates;
pub mod input_forms;
pub mod measure;
pub mod parse;
pub mod programs;
pub mod run_options;
pub mod scenes;
pub mod scenes_root;
pub mod sequence;
