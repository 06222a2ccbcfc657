//! The program `shuttertruth`: its arguments, its commands, and what they print.

mod commands;
#[cfg(test)]
mod guides;
mod program;

use std::ffi::OsString;

use filters::FilterError;
use frame::TruthError;
use measure::{Error, printable};
use program::{Cli, execute, find_new_place};
use terminal::output::{
    INTERRUPTED_TEXT, catch_interrupts, interrupted_code, print_error, print_failure, set_output,
};
use terminal::result::Ending;
use terminal::settings::Settings;
use tracer::TraceError;

pub use gate::{annotations, check_text, junit, summary};
pub use run::{compare_table, ranking_text, run_table, score_table};
pub use terminal::selection::{Programs, SceneChoice, select_filters, select_scenes};
pub use terminal::table::{list_once, markdown_table, range_text};

/// Runs the command of a command line, which begins with the program's name, and returns its exit
/// code.
pub fn run_program(words: &[OsString]) -> u8 {
    catch_interrupts();
    let settings = match Settings::read() {
        Ok(settings) => settings,
        Err(error) => {
            print_failure(&error);
            return exit_code(&error);
        }
    };
    let arguments = Cli::parse_words(words, &settings)
        .unwrap_or_else(|error| refuse_arguments(words, &error, &settings));
    set_output(arguments.output);
    match execute(&arguments) {
        Ok(Ending::Done) => 0,
        Ok(Ending::Failed(error)) => exit_code(&error),
        Err(error) => {
            if error.is_interruption() {
                print_error(INTERRUPTED_TEXT)
            } else {
                match way_out(&error) {
                    Some(way_out) => print_failure(&Error::Refused(format!("{error}; {way_out}"))),
                    None => print_failure(&error),
                }
            }
            exit_code(&error)
        }
    }
}

/// Chooses the exit code: 1 for a failed check, 2 for usage and bad input, 3 without an adapter, 4
/// if a truth stayed noisier than requested or than a check needs, 128 plus the number of a signal.
fn exit_code(error: &Error) -> u8 {
    match error {
        error if error.is_interruption() => interrupted_code(),
        Error::Filter(FilterError::NoAdapter) => 3,
        Error::Broken(_) => 1,
        Error::TooNoisy(_) | Error::Inconclusive(_) => 4,
        _ => 2,
    }
}

/// Names the options that solve a library's error; libraries know no options.
fn way_out(error: &Error) -> Option<&'static str> {
    match error {
        Error::Truth(TruthError::Foreign { .. }) => {
            Some("give all parts the same --size, --samples-per-pixel and --seed")
        }
        Error::Trace(TraceError::Undefined(_)) => Some("see --frames, --frame-rate, --exposure"),
        _ => None,
    }
}

/// Prints an error of the command line, or the requested help.
fn refuse_arguments(words: &[OsString], error: &clap::Error, settings: &Settings) -> ! {
    if let Some(place) = find_new_place(error) {
        print_failure(&Error::Refused(place));
        std::process::exit(error.exit_code())
    }
    // Words may be file names with control codes, which the message must show as escapes.
    let words = (words.iter()).map(|word| printable(&word.to_string_lossy()).into_owned());
    let shown = Cli::parse_words(words, settings).err();
    shown.as_ref().unwrap_or(error).exit()
}
