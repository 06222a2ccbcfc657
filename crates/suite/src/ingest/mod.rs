//! Ingesting: a capture becomes a frame, a truth and a picture in the files of this program.

mod convert;
pub mod engine_scene;
mod engine_truth;
mod moving;

pub use convert::{Ingested, ingest};
