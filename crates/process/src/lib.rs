//! Other programs that this one runs: compilers of shaders, filters that are commands, git. Only
//! this crate starts them.

#[cfg(target_os = "linux")]
mod descendants;
mod environment;
mod limits;
mod process_group;
mod run;

pub use environment::collect_environment;
pub use limits::{Limits, OutputFile, half_of_memory};
pub use run::{End, resume, run, stop};
