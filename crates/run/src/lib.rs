//! The main job: measures every filter on every scene, judges and ranks the results, and writes
//! run.json and its page. Other commands that measure share its plan and its files.

mod command;
mod ingested_scenes;
mod kept_truths;
mod measured;
mod pages;
mod plan;
mod previous;
mod tables;
mod watch;

pub use self::command::{RunArgs, execute};
pub use self::measured::{MeasuredRun, measure};
pub use self::pages::{
    WrittenFile, page_lines, page_path, refuse_folder, write_judgement, write_page, write_run,
    write_run_page,
};
pub use self::plan::{Margins, add_bounds, apply_options, lock_out, make_plan, read_margins};
pub use self::previous::PREVIOUS;
pub use self::tables::{failures_text, ranking_text, run_table, score_sequence_table, score_table};
