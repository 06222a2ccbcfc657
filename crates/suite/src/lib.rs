//! Measuring, judging, comparing and tuning of filters over scenes. Nothing here prints: results are data, progress goes to a
//! [`Monitor`].

mod audit;
mod bench;
mod cache;
mod capture;
mod colors;
mod compare;
mod error;
mod filter;
mod folder;
mod identity;
mod import;
mod ingest;
mod json;
mod judge;
mod measure;
mod monitor;
mod named;
mod pack;
mod people;
mod printable;
mod render;
mod results;
mod run;
mod score;
mod stats;
mod tune;
mod verify;

pub use audit::{
    Buffer, CaptureAudit, Cause, Defect, DepthAudit, ObjectAudit, ObjectShown, audit_capture,
    write_audit_picture,
};
pub use bench::{
    BASELINE, BENCH_FORMAT, Bench, BenchPlan, CaseCost, GROWTH_FROM, REACHES, ReachCost,
    ReachPoint, Spread, bench,
};
pub use capture::description::{CAPTURE_FILE, CaptureDescription};
pub use capture::folder::Capture;
pub use compare::{
    Agreement, Basis, COMPARE_FORMAT, Change, ChangeKind, FilterAtSizes, MeanChange, MeanKind,
    Pair, Reversal, RunComparison, SettingChange, Side, SizeComparison, compare_runs,
    compare_sizes, compare_with_last, pair_cases, rank_changes, score_change,
};
pub use error::Error;
pub use filter::border::Border;
pub use filter::buffer_size::BufferSize;
pub use filter::camera_jitter::CameraJitter;
pub use filter::choice::FilterChoice;
pub use filter::depth_format::DepthFormat;
pub use filter::depth_of_field::DepthOfField;
pub use filter::input_format::{InputFormat, InputForms};
pub use filter::multisampling::Multisampling;
pub use filter::render_scale::RenderScale;
pub use filter::runner::{Runner, open_adapter, open_gpu};
pub use filter::shutter_rule::ShutterRule;
pub use filter::velocity_defect::VelocityDefect;
pub use filter::velocity_format::VelocityFormat;
pub use folder::claim::{Claim, Sharing, claim};
pub use folder::numbered::{find_numbered, numbered_file};
pub use folder::placed_file::MOST_TAKEN_BYTES;
pub use folder::scene_folder::scene_folder;
pub use folder::tracked::refuse_tracked;
pub use identity::{CaseId, FilterId};
pub use import::{ImportPlan, Imported, Motions, Up, import};
pub use ingest::engine_scene::{EngineScene, INGESTED_FILE, engine_name};
pub use ingest::{Ingested, ingest};
pub use json::file::{MOST_JSON_BYTES, read_text};
pub use judge::baseline::{
    Acceptance, BASELINE_FORMAT, Baseline, BaselineComparison, ComparisonKind, accept_scores,
    compare_with_baseline,
};
pub use judge::bounds::{
    BOUNDS_FILE, Bound, Bounds, BoundsFile, FilterBounds, Length, Level, Margin, SceneBounds,
    bound_subframes, check_lengths, check_names, read_bounds, read_bounds_beside_scenes,
    read_bounds_file, require_bounds, size_for_bounds, sized_bounds_file,
};
pub use judge::calibrate::{Calibration, Proposal, Sample, calibrate, default_metrics};
pub use judge::check::{CHECK_FORMAT, Check, check};
pub use judge::decision::Decision;
pub use judge::{
    BLOCK, CROP, Decoys, FEW_SUBFRAMES, Finding, JUDGEMENT_FILE, JUDGEMENT_FORMAT, JudgedScore,
    Judgement, MOST_SAMPLES, Outcome, Resemblance, RunBounds, Worst, add_evidence, badness_within,
    judge, judge_scores, judge_sequence, make_wrong_pictures, number, worst_block,
};
pub use measure::estimate::{
    RunEstimate, estimate_case_seconds, estimate_render_seconds, estimate_run, estimate_run_roughly,
};
pub use measure::job_costs::{JobCost, SceneJobs, estimate_jobs, estimate_report};
pub use measure::part::Part;
pub use measure::plan::RunPlan;
pub use measure::references::scene_viewing;
pub use measure::scenes::{measure_scenes, measure_scenes_as_expected};
pub use measure::sequence::{CHANGE_PICTURE, SEQUENCE_PICTURE};
pub use monitor::{Monitor, Step};
pub use pack::arrival::{Arrival, take_pack};
pub use pack::manifest::{
    LARGEST_PACK_RATIO, MOST_MANIFEST_BYTES, Manifest, PACK_FORMAT, PackedFile,
};
pub use pack::reading::Pack;
pub use pack::writing::write_pack;
pub use people::agreement::PeopleAgreement;
pub use people::answers::{
    ANSWERS_FORMAT, Answer, AnswerFile, Chosen, DisplayFacts, MOST_ANSWER_BYTES, SHARP_CLIP,
    TRUTH_CLIP,
};
pub use people::clips::{ClipFiles, StudyChoice, make_study};
pub use people::design::{Clip, ShownPair, draw_session};
pub use people::preferences::{
    FilterStrength, PREFERENCES_FORMAT, Preferences, QuestionResult, SessionFacts, ShutterScale,
    find_preferences,
};
pub use people::question::Question;
pub use people::score_agreement::ScoreAgreement;
pub use people::session::{MOST_SESSIONS, Session, read_sessions, refuse_other_run};
pub use people::study::{
    MOST_ASKED_FILTERS, MOST_ASKED_SCENES, SECONDS_PER_QUESTION, Study, StudyShutter,
};
pub use printable::{printable, printable_lines, printable_path, printable_table};
pub use render::frames::render_frame;
pub use render::ladders::{LADDER, LadderFiles};
pub use render::merge::{MOST_PART_BYTES, Merged, merge};
pub use render::scatter_oracle::scatter_oracle;
pub use render::settings::{MOST_REPLICATES, SIDES};
pub use render::shared::render_shared;
pub use render::truths::{deciding_floor, render_part, render_truth, render_truths_until};
pub use results::{RESULTS_FORMAT, ResultCost, ResultScores, Results};
pub use run::case::{ACCUMULATE, Case, Drawn, IDENTITY, Intervals};
pub use run::earlier::{EarlierCases, find_newer_sizes, folder_for_size};
pub use run::error_maps::ErrorMaps;
pub use run::failure::{Failure, refuse_failures};
pub use run::file::MOST_CASES;
pub use run::layers::write_layers;
pub use run::merge::{MergedRun, holds_run, merge_runs};
pub use run::overall::Overall;
pub use run::sequence::{Frames, MOST_FRAMES, Sequence, SequenceFrame};
pub use run::{FORMAT, Run};
pub use score::finished_picture::{FinishedPicture, read_finished_picture};
pub use score::scores::{Scored, missing_scores, score};
pub use score::sequence::{ScoredSequence, SequenceTruth, file_at_frame, score_sequence};
pub use stats::intervals::{FEWEST_REPLICATES, intervals, truths_without_pairs};
pub use stats::lag::{lag_text, mean_lag};
pub use stats::overall::{overall, rank_filters};
pub use stats::preference_scale::{FEWEST_PEOPLE, RESAMPLES, Resampled};
pub use stats::ranking::{MOST_RANKED, RANK_RULE, RankedFilter, list_summarized, rank_for_summary};
pub use stats::scene_mean::{FEWEST_SCENES, SceneMean};
pub use stats::sequence_ranking::{RANKED_BY, RankedSequence, rank_sequences, rank_sequences_on};
pub use tune::{
    Advice, Choice, ChoiceLimits, Difference, Estimate, Evaluation, Evaluator, Fold, HeldOutResult,
    JOURNAL_FORMAT, Journal, JournalHeader, LEAST_BLEED, Objective, PairedComparison,
    ParameterSensitivity, Preference, RenderedScene, SceneScore, Search, Sensitivity, SobolIndices,
    Space, TUNE_FORMAT, Target, Trial, TrialOutcome, TuneOptions, Tuning, analyze_sensitivity,
    choose_trial, compare_candidates, count_candidates, cross_validate, evaluate_candidate,
    interleave_families, log_ratio, pareto_front, render_scenes, round_bleed, signed_rank_p_value,
    sobol_indices, tune, tuned_preset_toml,
};

pub use verify::chance::TILE_SIDE;
pub use verify::difference::TRAVERSALS;
pub use verify::kept_scene::{Verified, verify_scene};
pub use verify::listing::{KeptScene, list_kept_scenes};
pub use verify::work::Verification;

/// Program name and version, as files and runs record it.
pub const PROGRAM: &str = concat!("shuttertruth ", env!("CARGO_PKG_VERSION"));
