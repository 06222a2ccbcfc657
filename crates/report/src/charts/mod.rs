//! Charts as inline SVG.

pub mod plot;
pub mod strip;
