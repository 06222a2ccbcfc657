//! The commands of `engine`.

pub mod audit;
pub mod blur;
mod capture;
pub mod export;
pub mod import;
pub mod ingest;
mod show_texture;
