//! One file per command, and their shared work.

pub mod audit;
pub mod blur;
mod candidate;
mod capture;
pub mod compare;
pub mod compare_presets;
mod copy;
pub mod description;
pub mod evaluate;
pub mod export;
pub mod import;
pub mod ingest;
pub mod list;
pub mod render;
pub mod report;
pub mod score;
pub mod score_sequence;
pub mod sensitivity;
mod show_texture;
pub mod tune;
