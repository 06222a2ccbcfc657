//! The commands of `engine`.

pub mod audit;
mod audit_self;
pub mod blur;
mod capture;
pub mod export;
pub mod import;
pub mod ingest;
mod show_texture;
