//! One file per command, and their shared work.

pub mod blur;
mod candidate;
pub mod compare;
pub mod compare_presets;
mod convention;
mod copy;
pub mod description;
pub mod evaluate;
pub mod list;
pub mod render;
pub mod report;
pub mod score;
pub mod score_sequence;
pub mod sensitivity;
mod show_texture;
pub mod tune;
