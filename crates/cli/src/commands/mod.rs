//! One file per command, and their shared work.

pub mod blur;
pub mod compare;
mod convention;
mod copy;
pub mod description;
pub mod list;
pub mod new;
pub mod render;
pub mod report;
pub mod score;
pub mod score_sequence;
mod show_texture;
