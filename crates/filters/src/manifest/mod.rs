//! `filter.toml`.

mod bindings;
mod command;
mod convention;
mod file;
mod number;
mod parameters;
mod parse;
mod pass_shader;
mod passes;
mod presets;
mod reach_by;
mod source;

pub use file::MAX_ENTRIES;
pub use parameters::MAX_CHOICES;
pub(crate) use parse::parse;
pub use passes::{MAX_DISPATCHES, MAX_MIPS};
