//! The folder that a command writes to.

pub mod claim;
pub mod forget;
pub mod tracked;
