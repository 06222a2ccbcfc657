//! `shuttertruth`: measures real-time motion blur against true shutter blur.

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run_program()
}
