//! `filter.toml`.

mod bindings;
mod command;
mod convention;
mod divisors;
mod file;
mod parameters;
mod parse;
mod pass_shader;
mod passes;
mod presets;
mod reach_by;
mod source;
mod time_limit;

pub use file::MAX_ENTRIES;
pub use parameters::MAX_CHOICES;
pub(crate) use parse::parse;
pub use passes::{MAX_DISPATCHES, MAX_MIPS};
