//! Ranks of filters, from the means of their scores.

pub mod lag;
#[expect(clippy::module_inception)]
pub mod ranking;
pub mod sequence_ranking;
