//! Cases, runs and bounds over the scenes, filters and metrics; the command line `shuttertruth` is a thin layer on top.

mod baseline;
mod bench;
mod bounds;
mod calibrate;
mod case;
mod catalogue;
mod claim;
mod compare;
mod dilated;
mod error;
mod failure;
mod finished;
mod forget;
mod gate;
mod headline;
mod import;
mod input_format;
mod inputs;
mod intervals;
mod json_file;
mod json_strings;
mod judge;
mod kept;
mod layers;
mod means_table;
mod memory;
mod merge;
mod overall;
mod paint;
mod pictures;
mod printable;
mod probe;
mod progress;
mod rendered;
mod replicates;
mod report;
mod run;
mod run_file;
mod runner;
mod scatter_oracle;
mod scene_mean;
mod scene_run;
mod score;
mod selection;
mod subject;
mod table;
mod tracked;
mod tune;
mod workbench;
mod wrapped;

pub use baseline::{
    Acceptance, BASELINE_FORMAT, Baseline, Comparison, ComparisonKind, accept, compare,
};
pub use bench::{BASELINE, Bench, BenchPlan, bench, bench_table};
pub use bounds::{
    BOUNDS_FILE, Bound, Bounds, BoundsFile, FilterBounds, Level, Margin, SceneBounds, bounded_size,
    check_bounded, check_names, read_bounds, read_bounds_file,
};
pub use calibrate::{Calibration, Proposal, Sample, calibrate};
pub use case::Case;
pub use catalogue::catalogue;
pub use claim::{Claim, Sharing, claim};
pub use compare::{
    Basis, COMPARE_FORMAT, Change, ChangeKind, Compared, MeanChange, MeanKind, SettingChange, Side,
    compare_page, compare_runs, compare_table,
};
pub use error::Error;
pub use failure::{Failure, failures_text, refuse_failures};
pub use finished::{Finished, read_finished};
pub use gate::{CHECK_FORMAT, Check, Decision, annotations, check, check_text, junit, summary};
pub use import::{ImportPlan, Imported, Motions, Up, import};
pub use input_format::{Border, DepthFormat, InputFormat, VelocityFormat};
pub use intervals::{FEWEST_REPLICATES, Intervals, intervals, truths_without_pairs};
pub use json_file::MOST_JSON_BYTES;
pub use judge::{
    Decoys, Finding, JUDGEMENT_FILE, JUDGEMENT_FORMAT, Judged, Judgement, Outcome, Resemblance,
    RunBounds, Worst, add_evidence, judge, judge_scores,
};
pub use layers::write_layers;
pub use merge::{MOST_PART_BYTES, Merged, merge};
pub use overall::{Overall, overall};
pub use printable::{printable, printable_lines, printable_path, printable_table};
pub use progress::{catch_interrupts, interrupted, tell, with_bar};
pub use rendered::{
    LADDER, RenderSettings, SIDES, deciding_floor, frame_of, part_of, scene_folder,
    truth_and_ladder_of, truth_of, truth_until,
};
pub use replicates::MOST_REPLICATES;
pub use report::{LARGEST_PAGE, Report, TuneFolder, report, tuning_page};
pub use run::{FORMAT, Plan, Run, run, viewing};
pub use run_file::MOST_CASES;
pub use runner::{Runner, open_adapter, open_gpu};
pub use scatter_oracle::scatter_oracle;
pub use score::{Scored, missing, score};
pub use selection::{FilterChoice, Programs, SceneChoice, select_filters, select_scenes};
pub use table::{score_table, table};
pub use tracked::refuse_tracked;
pub use tune::{
    Answer, Choice, Difference, Effort, ElementaryEffects, Estimate, Evaluator, Fold, Header,
    JOURNAL_FORMAT, Journal, LEAST_BLEED, Limits, Objective, Opening, Paired, ParameterSensitivity,
    Preference, SceneScore, Search, Sensitivity, Shot, SobolIndices, Space, TUNE_FORMAT, Target,
    Trial, TrialOutcome, TunePlan, Tuning, answer, choose, compare_paired, evaluator, folds, front,
    interleaved, morris, paired_table, preset_text, probability_not_above, sensitivity,
    sensitivity_table, shots, sobol_indices, tune, tuning_table,
};
pub use wrapped::push_wrapped;

/// Program name and version, as files and runs record it.
pub const PROGRAM: &str = concat!("shuttertruth ", env!("CARGO_PKG_VERSION"));
