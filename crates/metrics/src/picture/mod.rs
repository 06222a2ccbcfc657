//! Errors of a whole picture: maps of colour and labels, pooled over regions.

pub mod error_maps;
pub mod pooled;
pub mod scores;
pub mod seen_truth;
