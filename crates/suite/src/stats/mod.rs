//! Statistics of scores: intervals of one score, and means over the scenes of a run.

pub mod bradley_terry;
pub mod intervals;
pub mod lag;
pub mod overall;
pub mod paired_counts;
pub mod preference_scale;
pub mod rank_correlation;
pub mod ranking;
pub mod scene_mean;
pub mod sequence_ranking;
