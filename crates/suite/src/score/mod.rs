//! Scores of pictures that were made elsewhere.

pub mod finished_picture;
pub mod numbered;
pub mod scores;
pub mod sequence;
