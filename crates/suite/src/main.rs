//! `shuttertruth`: measures real-time motion blur against true shutter blur.

mod cli;
mod commands;
mod words;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    suite::catch_interrupts();
    match commands::execute(cli::Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("shuttertruth: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}
