//! Error put into proportion: skill and equivalent sub-frames.

pub mod curve;
pub mod ladder;
pub mod skill;
