//! JSON files: how they are written, and read whoever wrote them.

pub mod file;
pub mod lines;
pub mod strings;
