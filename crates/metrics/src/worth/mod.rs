//! Error put into proportion: skill and equivalent sub-frames.

pub mod equivalent;
pub mod ladder;
pub mod skill;

pub use equivalent::{Equivalent, LadderRange, Subframes};
