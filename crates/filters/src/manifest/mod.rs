//! `filter.toml`.

mod bindings;
mod command;
mod convention;
mod defines;
mod file;
mod number;
mod parameters;
mod parse;
mod pass_shader;
mod passes;
mod presets;
mod source;

pub use number::check_filter_name;
pub(crate) use parse::parse;
