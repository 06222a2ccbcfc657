//! Scores: metrics, their intervals, and rankings.

mod decoy_matrix;
mod decoys;
mod flip_parity;
mod intervals;
mod invariance;
mod knowledge;
mod noise;
mod ranking;
mod scatter_oracle;
mod scores;
