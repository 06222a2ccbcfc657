//! `shuttertruth`: measures real-time motion blur against true shutter blur.

use std::ffi::OsString;
use std::process::ExitCode;

fn main() -> ExitCode {
    let words: Vec<OsString> = std::env::args_os().collect();
    ExitCode::from(cli::run_program(&words))
}
