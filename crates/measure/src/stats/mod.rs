//! Statistics of scores: intervals of one score, and means over the scenes of a run.

pub mod intervals;
pub mod overall;
pub mod parts;
pub mod scene_mean;
