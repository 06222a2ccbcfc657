//! `shuttertruth`: measures real-time motion blur against true shutter blur.

mod cli;
mod commands;
mod words;

use std::process::ExitCode;

use clap::Parser;
use suite::{printable, printable_lines, tell};

fn main() -> ExitCode {
    suite::catch_interrupts();
    let words = cli::Cli::try_parse().unwrap_or_else(|error| refuse_words(&error));
    match commands::execute(words) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            tell(&printable_lines(&format!("shuttertruth: {error}")));
            ExitCode::from(error.exit_code())
        }
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
