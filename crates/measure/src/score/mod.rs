//! Scores of pictures from elsewhere.

pub mod convention;
pub mod finished_picture;
pub mod numbered;
pub mod picture_file;
pub mod reached;
pub mod reference;
pub mod scores;
pub mod sequence;
