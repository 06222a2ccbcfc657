//! Ingesting: conversion of a capture to a frame, a truth and a picture in this program's files.

mod convert;
mod engine_truth;
pub mod moving;
mod objects;

pub use convert::{IngestPlan, Ingested, ingest};
pub use engine_truth::check_subframe_count;
