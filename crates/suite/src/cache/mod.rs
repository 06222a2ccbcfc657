//! Results of earlier runs in an output folder, found again by hashes of what they were made from.

pub mod clear;
pub mod record;
