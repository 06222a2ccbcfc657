//! One file per command, and their shared work.

pub mod accept;
pub mod audit;
pub mod blur;
pub mod calibrate;
mod capture;
pub mod check;
pub mod compare;
mod copy;
pub mod description;
pub mod export;
pub mod import;
pub mod ingest;
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
mod show_texture;
