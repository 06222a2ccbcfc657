//! Packs: the kept frames, truths and ladders of a run in one archive, which says what it holds and is checked before it is used.

pub mod arrival;
pub mod contents;
pub mod manifest;
pub mod reading;
pub mod writing;
