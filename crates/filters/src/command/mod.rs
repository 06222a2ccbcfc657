//! Filters that are programs: a frame goes out as a file, and a picture comes back as one.

mod blur;
#[cfg(target_os = "linux")]
mod descendants;
mod environment;
mod output_tail;
mod process;
mod process_group;

pub use blur::CommandBlur;
pub(crate) use environment::collect_environment;
