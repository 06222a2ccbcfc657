//! One file per command, and their shared work.

pub mod accept;
pub mod blur;
pub mod calibrate;
mod candidate;
pub mod check;
pub mod compare;
pub mod compare_presets;
mod convention;
mod copy;
pub mod description;
pub mod evaluate;
mod ingested_scenes;
mod kept_truths;
pub mod list;
mod measured_run;
pub mod merge;
mod pages;
pub mod render;
pub mod report;
pub mod run;
mod run_plan;
pub mod score;
pub mod score_sequence;
pub mod sensitivity;
mod show_texture;
pub mod tune;
