//! Statistics of scores: intervals of one score, and means over the scenes of a run.

pub mod headline;
pub mod intervals;
pub mod lag;
pub mod overall;
pub mod ranking;
pub mod scene_mean;
pub mod sequence_ranking;
