//! The program `shuttertruth`: its arguments, its commands, and what they print.

mod arguments;
mod commands;
mod output;
mod selection;
mod tables;

use std::process::ExitCode;

use clap::Parser;
use filters::FilterError;
use suite::{Error, printable, printable_lines};

use output::progress::{INTERRUPTED_CODE, catch_interrupts, tell};

pub use output::github::{annotations, summary};
pub use output::junit::junit;
pub use selection::{Programs, SceneChoice, select_filters, select_scenes};
pub use tables::bench::bench_table;
pub use tables::cases::{score_table, table};
pub use tables::check::check_text;
pub use tables::comparison::compare_table;
pub use tables::tuning::{paired_table, tuning_table};

/// Does what the words of the command line say, and returns the exit code.
pub fn run_program() -> ExitCode {
    catch_interrupts();
    let arguments = arguments::Cli::try_parse().unwrap_or_else(|error| refuse_words(&error));
    match commands::execute(arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            tell(&printable_lines(&format!("shuttertruth: {error}")));
            ExitCode::from(exit_code(&error))
        }
    }
}

/// 1 where a check fails, 2 for usage and bad input, 3 where there is no adapter, 4 where a truth stayed noisier than asked for
/// or than a check needs, 130 after Ctrl-C.
fn exit_code(error: &Error) -> u8 {
    match error {
        error if error.is_interruption() => INTERRUPTED_CODE,
        Error::Filter(FilterError::NoAdapter) => 3,
        Error::Broken(_) => 1,
        Error::TooNoisy(_) | Error::Inconclusive(_) => 4,
        _ => 2,
    }
}

/// Says what is wrong with the command line, or prints its help. The message quotes the words.
fn refuse_words(error: &clap::Error) -> ! {
    let all_fit = std::env::args_os().all(|word| {
        let word = word.to_string_lossy();
        printable(&word) == word
    });
    match all_fit {
        true => error.exit(),
        false => {
            tell(&printable_lines(error.to_string().trim_end()));
            std::process::exit(error.exit_code())
        }
    }
}
