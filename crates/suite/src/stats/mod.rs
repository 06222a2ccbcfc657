//! Statistics over the scenes of a run.

pub mod headline;
pub mod overall;
pub mod ranking;
pub mod scene_mean;
