//! Compilation of a shader by a program on the PATH: to SPIR-V, or from WESL to WGSL.

mod installed;
mod messages;
mod run;

pub use installed::list_installed;
pub use run::compile;
