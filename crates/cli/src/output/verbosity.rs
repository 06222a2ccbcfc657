//! Amount of output, set once when the program begins.

use std::sync::OnceLock;

use anstream::ColorChoice;

use crate::arguments::{Color, OutputArgs};

/// Amount of output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verbosity {
    /// Results alone, without progress.
    Quiet,
    /// Results and progress.
    Usual,
    /// More details than usual.
    Verbose,
}

static VERBOSITY: OnceLock<Verbosity> = OnceLock::new();

/// Sets the amount and the colours of output.
pub fn set_output(args: OutputArgs) {
    let verbosity = match (args.quiet, args.verbose) {
        (true, _) => Verbosity::Quiet,
        (false, true) => Verbosity::Verbose,
        (false, false) => Verbosity::Usual,
    };
    let _ = VERBOSITY.set(verbosity);
    match args.color {
        Color::Auto => ColorChoice::Auto,
        Color::Always => ColorChoice::AlwaysAnsi,
        Color::Never => ColorChoice::Never,
    }
    .write_global();
}

/// Looks up the amount of output; the usual one where none was set.
pub fn verbosity() -> Verbosity {
    VERBOSITY.get().copied().unwrap_or(Verbosity::Usual)
}
