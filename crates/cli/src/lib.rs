//! The program `shuttertruth`: its arguments, its commands, and what they print.

mod arguments;
mod commands;
mod environment;
mod output;
mod selection;
mod tables;

use std::ffi::OsString;
use std::process::ExitCode;
use suite::Error;

use clap::FromArgMatches;
use clap::error::ErrorKind;
use filters::FilterError;

use commands::Ending;
use environment::set_environment;
use output::interrupts::{INTERRUPTED_TEXT, catch_interrupts, interrupted_code};
use output::print::{print_error, print_failure};
use output::verbosity::set_output;

pub use output::annotations::{annotations, summary};
pub use output::junit::junit;

pub use selection::{Programs, SceneChoice, select_filters, select_scenes};
pub use tables::cases::{run_table, score_table};
pub use tables::check::check_text;
pub use tables::comparison::compare_table;
pub use tables::preferences::preferences_table;
pub use tables::ranking::ranking_text;
pub use tables::results_filter_page::{picture_name, results_filter_pages};
pub use tables::results_page::{main_results, results_page};
pub use tables::tuning::paired_table;

/// Runs the command of the command line and returns its exit code.
pub fn run_program() -> ExitCode {
    let is_verbose = |argument: OsString| argument == "-v" || argument == "--verbose";
    set_environment(std::env::args_os().any(is_verbose));
    catch_interrupts();
    let arguments = parse_arguments().unwrap_or_else(|error| refuse_arguments(&error));
    set_output(arguments.output);
    match commands::execute(arguments) {
        Ok(Ending::Done) => ExitCode::SUCCESS,
        Ok(Ending::Failed(error)) => ExitCode::from(exit_code(&error)),
        Err(error) => {
            match error.is_interruption() {
                true => print_error(INTERRUPTED_TEXT),
                false => print_failure(&error),
            }
            ExitCode::from(exit_code(&error))
        }
    }
}

/// Parses the command line.
fn parse_arguments() -> Result<arguments::Cli, clap::Error> {
    let mut program = arguments::command_line();
    let matches = program.try_get_matches_from_mut(std::env::args_os())?;
    arguments::Cli::from_arg_matches(&matches).map_err(|error| error.format(&mut program))
}

/// Chooses the exit code: 1 where a check fails, 2 for usage and bad input, 3 where there is no adapter, 4 where a truth stayed noisier than asked for
/// or than a check needs, 128 and the number of the signal after one.
fn exit_code(error: &Error) -> u8 {
    match error {
        error if error.is_interruption() => interrupted_code(),
        Error::Filter(FilterError::NoAdapter) => 3,
        Error::Broken(_) => 1,
        Error::TooNoisy(_) | Error::Inconclusive(_) => 4,
        _ => 2,
    }
}

/// Prints the error in the command line, or the help that it asks for.
fn refuse_arguments(error: &clap::Error) -> ! {
    let is_help = matches!(
        error.kind(),
        ErrorKind::DisplayHelp
            | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand
            | ErrorKind::DisplayVersion
    );
    if is_help {
        error.exit()
    }
    let words: Vec<OsString> = std::env::args_os().skip(1).collect();
    print_failure(&Error::Usage(arguments::refusal_text(error, &words)));
    std::process::exit(error.exit_code())
}
