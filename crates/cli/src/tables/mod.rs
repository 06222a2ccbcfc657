//! Tables of results, in 80 columns.

pub mod adapter;
pub mod annotations;
pub mod audit;
pub mod bench;
pub mod cases;
pub mod check;
pub mod columns;
pub mod comparison;
pub mod failures;
pub mod frame_rates;
pub mod input_forms;
pub mod jobs;
pub mod junit;
pub mod layout;
pub mod listing;
pub mod missing;
pub mod preferences;
pub mod ranking;
pub mod results_filter_page;
pub mod results_page;
pub mod scene_means;
pub mod sensitivity;
pub mod sequence;
pub mod tuning;
