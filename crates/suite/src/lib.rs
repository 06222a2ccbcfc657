//! Measuring, judging, comparing and tuning of filters over scenes. Nothing here prints: results are data, progress goes to a
//! [`Monitor`].

mod bench;
mod case;
mod compare;
mod error;
mod folder;
mod import;
mod json;
mod judge;
mod monitor;
mod printable;
mod render;
mod run;
mod stats;
mod tune;

pub use bench::{
    BASELINE, BENCH_FORMAT, Bench, BenchPlan, CaseCost, GROWTH_FROM, REACHES, ReachCost,
    ReachPoint, Spread, bench,
};
pub use case::{ACCUMULATE, Case, IDENTITY, SCATTER_ORACLE};
pub use compare::{
    Basis, COMPARE_FORMAT, Change, ChangeKind, Compared, MeanChange, MeanKind, Pair, SettingChange,
    Side, compare_runs, pairs, rank_changes, subject,
};
pub use error::Error;
pub use folder::claim::{Claim, Sharing, claim};
pub use folder::tracked::refuse_tracked;
pub use import::{ImportPlan, Imported, Motions, Up, import};
pub use json::file::{MOST_JSON_BYTES, read_text};
pub use judge::baseline::{
    Acceptance, BASELINE_FORMAT, Baseline, Comparison, ComparisonKind, accept, compare,
};
pub use judge::bounds::{
    BOUNDS_FILE, Bound, Bounds, BoundsFile, FilterBounds, Level, Margin, SceneBounds, bounded_size,
    check_bounded, check_names, read_bounds, read_bounds_file,
};
pub use judge::calibrate::{Calibration, Proposal, Sample, calibrate};
pub use judge::check::{CHECK_FORMAT, Check, Decision, check};
pub use judge::{
    BLOCK, CROP, Decoys, Finding, JUDGEMENT_FILE, JUDGEMENT_FORMAT, Judged, Judgement,
    MOST_SAMPLES, Outcome, Resemblance, RunBounds, Worst, add_evidence, judge, judge_scores,
    limit_as_badness, number, worst_block,
};
pub use monitor::{Monitor, Step};
pub use printable::{printable, printable_lines, printable_path, printable_table};
pub use render::layers::write_layers;
pub use render::merge::{MOST_PART_BYTES, Merged, merge};
pub use render::rendered::{
    LADDER, RenderSettings, SIDES, deciding_floor, frame_of, part_of, scene_folder,
    truth_and_ladder_of, truth_of, truth_until,
};
pub use render::replicates::MOST_REPLICATES;
pub use render::scatter_oracle::scatter_oracle;
pub use run::earlier::EarlierCases;
pub use run::estimate::{
    RunEstimate, estimate_case_seconds, estimate_render_seconds, estimate_run,
};
pub use run::failure::{Failure, refuse_failures};
pub use run::file::MOST_CASES;
pub use run::filter_choice::FilterChoice;
pub use run::finished::{Finished, read_finished};
pub use run::input_format::{Border, DepthFormat, InputFormat, VelocityFormat};
pub use run::intervals::{FEWEST_REPLICATES, Intervals, intervals, truths_without_pairs};
pub use run::runner::{Runner, open_adapter, open_gpu};
pub use run::score::{Scored, missing, score};
pub use run::{FORMAT, Plan, Run, run, viewing};
pub use stats::headline::Headline;
pub use stats::overall::{Overall, overall, rank_filters};
pub use stats::ranking::{RankedFilter, rank_by_flip};
pub use tune::{
    Answer, Choice, Difference, Effort, ElementaryEffects, Estimate, Evaluator, Fold, Header,
    JOURNAL_FORMAT, Journal, LEAST_BLEED, Limits, Objective, Opening, Paired, ParameterSensitivity,
    Preference, SceneScore, Search, Sensitivity, Shot, SobolIndices, Space, TUNE_FORMAT, Target,
    Trial, TrialOutcome, TunePlan, Tuning, answer, choose, compare_paired, evaluator, folds, front,
    interleaved, log_ratio, morris, preset_text, probability_not_above, sensitivity, shots,
    sobol_indices, tune,
};

/// Program name and version, as files and runs record it.
pub const PROGRAM: &str = concat!("shuttertruth ", env!("CARGO_PKG_VERSION"));
