//! The commands of `tune`.

mod candidate;
mod compare;
mod evaluate;
mod search;
mod sensitivity;

use clap::Subcommand;
use measure::Error;

pub use self::candidate::CandidateArgs;

/// The commands of `tune`.
#[derive(Debug, Subcommand)]
pub enum TuneCommand {
    /// Search for parameters that bring a filter nearer to the truth
    ///
    /// Writes journal.jsonl and tune.json.
    Search(search::SearchArgs),
    /// Estimate which parameters of a filter matter, by Sobol indices
    ///
    /// Writes sensitivity.json.
    Sensitivity(sensitivity::SensitivityArgs),
    /// Compare two presets of a filter, scene by scene
    ///
    /// Writes compare.json.
    #[command(alias = "compare-presets")]
    Compare(compare::CompareArgs),
    /// Score one set of parameters; print JSON
    Evaluate(evaluate::EvaluateArgs),
}

/// Does the work of a command.
pub fn execute(command: &TuneCommand) -> Result<(), Error> {
    match command {
        TuneCommand::Search(args) => search::execute(args),
        TuneCommand::Sensitivity(args) => sensitivity::execute(args),
        TuneCommand::Compare(args) => compare::execute(args),
        TuneCommand::Evaluate(args) => evaluate::execute(args),
    }
}
