//! Joins what several machines made: replicates of truths, or runs of some of the cases.

mod command;
mod files;
mod gather;
mod runs;
mod truths;

pub use self::command::{MergeArgs, execute};
pub use self::runs::merge_runs;
pub use self::truths::{Merged, merge_truths};
