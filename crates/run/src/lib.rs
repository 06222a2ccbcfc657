//! The main job: measures every filter on every scene, judges and ranks the results, and writes
//! run.json and its page. Beside it its two halves in commands of their own: rendering without
//! measuring, and comparing two finished runs. Other commands that measure share its plan and files.

mod command;
mod compare;
mod ingested_scenes;
mod kept_truths;
mod measured;
mod noise;
mod pages;
mod plan;
mod previous;
mod render;
mod tables;
mod watch;

pub use self::command::{RunArgs, execute};
pub use self::compare::{CompareArgs, execute as execute_compare};
pub use self::measured::{MeasuredRun, measure};
pub use self::noise::choose_samples;
pub use self::pages::{
    RunPage, WrittenFile, page_lines, page_path, refuse_folder, write_judgement, write_page,
    write_run,
};
pub use self::plan::{Margins, add_bounds, apply_options, lock_out, make_plan, read_margins};
pub use self::previous::PREVIOUS;
pub use self::render::{RenderArgs, execute as execute_render};
pub use self::tables::{
    compare_table, failures_text, ranking_text, run_table, score_sequence_table, score_table,
    shows_smears,
};
