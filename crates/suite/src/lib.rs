//! Cases, runs and bounds over the scenes, filters and metrics; the command line `shuttertruth` is a thin layer on top.

mod bench;
mod bounds;
mod case;
mod error;
mod finished;
mod input_format;
mod merge;
mod pictures;
mod probe;
mod progress;
mod rendered;
mod replicates;
mod run;
mod runner;
mod scatter_oracle;
mod score;
mod selection;
mod table;
mod workbench;

pub use bench::{BASELINE, Bench, BenchPlan, bench, bench_table};
pub use bounds::{Bounds, Outcome, Verdict, judge, read_bounds};
pub use case::Case;
pub use error::Error;
pub use finished::{Finished, read_finished};
pub use input_format::{Border, DepthFormat, InputFormat, VelocityFormat};
pub use merge::{Merged, merge};
pub use progress::{catch_interrupts, with_bar};
pub use rendered::{
    LADDER, RenderSettings, deciding_floor, frame_of, part_of, scene_folder, truth_and_ladder_of,
    truth_of, truth_until,
};
pub use run::{FORMAT, Plan, Run, run, viewing};
pub use runner::{Runner, open_gpu};
pub use scatter_oracle::scatter_oracle;
pub use score::{Scored, missing, score};
pub use selection::{FilterChoice, SceneChoice, select_filters, select_scenes};
pub use table::{score_table, table};

/// Program name and version, as files and runs record it.
pub const PROGRAM: &str = concat!("shuttertruth ", env!("CARGO_PKG_VERSION"));
