//! The commands of `engine` that exchange scenes and frames with engines.

pub mod audit;
mod capture;
pub mod export;
pub mod import;
pub mod ingest;
