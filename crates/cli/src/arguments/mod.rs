//! Arguments of the program and of each command.

mod accept;
mod adapter;
mod ask;
mod audit;
mod bench;
mod blur;
mod calibrate;
mod candidate;
mod check;
#[cfg(test)]
mod commands_page;
mod compare;
mod compare_presets;
mod completions;
mod evaluate;
mod export;
mod frame_rates;
mod given;
mod groups;
#[cfg(test)]
mod guides;
mod import;
mod ingest;
mod input_forms;
mod list;
mod man;
mod measure;
mod merge;
mod output;
mod pack;
mod parse;
mod plan;
mod preferences;
mod programs;
mod refusal;
mod render;
mod report;
mod run;
mod run_options;
mod scenes;
mod scenes_root;
mod score;
mod sensitivity;
mod sequence;
mod serve;
mod tune;
mod verify;

use clap::{Parser, Subcommand};

pub use accept::AcceptArgs;
pub use ask::AskArgs;
pub use audit::AuditArgs;
pub use bench::BenchArgs;
pub use blur::BlurArgs;
pub use calibrate::CalibrateArgs;
pub use candidate::CandidateArgs;
pub use check::CheckArgs;
pub use compare::CompareArgs;
pub use compare_presets::ComparePresetsArgs;
pub use completions::CompletionsArgs;
pub use evaluate::EvaluateArgs;
pub use export::ExportArgs;
pub use given::{given_options, words_behind};
pub use groups::{command_line, visible_command_line};
pub use import::ImportArgs;
pub use ingest::IngestArgs;
pub use list::ListArgs;
pub use man::ManArgs;
pub use measure::MeasureArgs;
pub use merge::MergeArgs;
pub use output::{Color, OutputArgs};
pub use pack::PackArgs;
pub use parse::Replicates;
pub use plan::PlanArgs;
pub use preferences::PreferencesArgs;
pub use refusal::refusal_text;
pub use render::RenderArgs;
pub use report::ReportArgs;
pub use run::RunArgs;
pub use run_options::RunOptions;
pub use scenes::SceneArgs;
pub use score::ScoreArgs;
pub use sensitivity::SensitivityArgs;
pub use serve::ServeArgs;
pub use tune::TuneArgs;
pub use verify::VerifyArgs;

/// Version, commit and target of the program.
const VERSION: &str = env!("SHUTTERTRUTH_VERSION");

/// Measures real-time motion blur against true shutter blur: renders the truth of moving scenes, runs filters on one frame
/// of each, and measures how far their pictures are from the truth.
#[derive(Debug, Parser)]
#[command(
    name = "shuttertruth",
    version = VERSION,
    max_term_width = 100,
    arg_required_else_help = true
)]
pub struct Cli {
    /// The command.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// List the adapters that filters can run on.
    #[arg(long)]
    pub list_adapters: bool,
    #[command(flatten)]
    pub output: OutputArgs,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Render scenes, run filters, measure them. Prints a ranking; writes report.html, run.json, EXR and PNG.
    Run(RunArgs),
    /// Run, and hold every score to its bound. The exit code tells pass or fail.
    Check(CheckArgs),
    /// Make the scores of a finished run the baseline of later checks.
    Accept(AcceptArgs),
    /// Run several times, measure how scores scatter, and propose bounds.
    Calibrate(CalibrateArgs),
    /// Render frames and truths only, or some replicates of them.
    Render(RenderArgs),
    /// Split a run into jobs for several machines. Renders nothing; prints a table, or JSON.
    Plan(PlanArgs),
    /// Join what several machines made: replicates of truths, or runs of some of the cases.
    Merge(MergeArgs),
    /// Put the kept truths of a finished run into one archive, from which other machines run.
    Pack(PackArgs),
    /// Trace random tiles of kept truths again, and compare them with the files byte for byte.
    Verify(VerifyArgs),
    /// Run a filter on a frame file.
    Blur(BlurArgs),
    /// Measure a finished picture from any source.
    Score(ScoreArgs),
    /// Write a finished run or tuning as one HTML page that needs no network.
    Report(ReportArgs),
    /// Compare two finished runs: which scores changed by more than noise, and by enough to matter.
    Compare(CompareArgs),
    /// Make a page that asks people which pictures of a finished run look better, or more like the truth.
    Ask(AskArgs),
    /// Turn the answers of people into a scale of filters, and compare scores with it.
    Preferences(PreferencesArgs),
    /// Time filters pass by pass, and against their blur length. Prints tables; writes bench.json.
    Bench(BenchArgs),
    /// Search parameters that bring a filter nearer to the truth. Writes journal.jsonl and tune.json.
    Tune(TuneArgs),
    /// Tell which parameters of a filter matter, by Sobol indices. Writes sensitivity.json.
    Sensitivity(SensitivityArgs),
    /// Compare two presets of a filter, scene by scene. Writes compare.json.
    ComparePresets(ComparePresetsArgs),
    /// Score one set of parameters. Prints JSON.
    Evaluate(EvaluateArgs),
    /// Score sets of parameters on request: JSON lines on standard input and output.
    Serve(ServeArgs),
    /// Make a scene of an OBJ file, with camera, floor, wall and motion.
    Import(ImportArgs),
    /// Write scenes as glTF 2.0, so that an engine can draw them.
    Export(ExportArgs),
    /// Make a frame, a truth and a picture of what an engine drew, so that `run` and `score` can measure them.
    Ingest(IngestArgs),
    /// Compare an engine's velocity and depth with those of the scene that it drew, and name what is wrong.
    Audit(AuditArgs),
    /// List scenes, filters, parameters and presets.
    List(ListArgs),
    /// Print completions for a shell.
    Completions(CompletionsArgs),
    /// Write the pages of the manual.
    Man(ManArgs),
}
