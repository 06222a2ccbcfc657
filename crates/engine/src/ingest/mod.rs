//! Ingesting: a capture becomes a frame, a truth and a picture in the files of this program.

mod convert;
mod engine_truth;
mod moving;
mod objects;

pub use convert::{Ingested, ingest};
