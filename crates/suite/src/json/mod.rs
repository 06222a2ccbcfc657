//! JSON that others wrote.

pub mod file;
pub mod strings;
