//! Scores of a sequence: changes from frame to frame that a viewer sees and no single frame shows.

mod along;
mod fixed_pattern;
mod instant;
mod jod;
mod measurement;
mod pairs;
mod popping;
mod reference;
mod temporal_antialiasing;

pub use instant::Instant;
pub use jod::{JOD_DISPLAY, video_jod};
pub use measurement::SequenceMeasurement;
pub use reference::SequenceReference;
pub use temporal_antialiasing::{NEW_SHARE, accumulate};
