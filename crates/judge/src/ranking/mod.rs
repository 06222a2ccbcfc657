//! Ranks of filters, from the means of their scores.

pub mod filters;
pub mod lag;
pub mod no_blur;
pub mod separation;
pub mod sequence_ranking;
pub mod side_effects;
