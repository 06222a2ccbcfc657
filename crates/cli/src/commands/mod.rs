//! One file per command, and their shared work.

mod copy;
pub mod description;
pub mod list;
mod listing;
pub mod new;
pub mod report;
