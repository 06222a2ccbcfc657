//! Amount of output, set once when the program begins.

use std::sync::OnceLock;

use anstream::ColorChoice;

use crate::arguments::{Color, OutputArgs};

static OUTPUT: OnceLock<OutputArgs> = OnceLock::new();

/// Sets the amount and the colours of output.
pub fn set_output(args: OutputArgs) {
    let _ = OUTPUT.set(args);
    match args.color {
        Color::Auto => ColorChoice::Auto,
        Color::Always => ColorChoice::AlwaysAnsi,
        Color::Never => ColorChoice::Never,
    }
    .write_global();
}

/// Tells whether progress is not to be shown.
pub fn is_quiet() -> bool {
    OUTPUT.get().is_some_and(|output| output.quiet)
}

/// Tells whether more is to be shown than usual.
pub fn is_verbose() -> bool {
    OUTPUT.get().is_some_and(|output| output.verbose)
}
