//! Amount of output, set once when the program begins.

use std::sync::OnceLock;

use anstream::ColorChoice;
use clap::Args;

/// Amount and colours of output; every command has these arguments.
#[derive(Clone, Copy, Debug, Args)]
#[command(next_help_heading = "Output")]
pub struct OutputArgs {
    /// Show no progress
    #[arg(short, long, global = true)]
    pub quiet: bool,
    /// Show missed targets, and messages of the graphics driver
    #[arg(short, long, global = true)]
    pub verbose: bool,
    /// Colours: auto (unless NO_COLOR is set), always or never
    #[arg(
        long,
        global = true,
        value_name = "WHEN",
        default_value = "auto",
        hide_default_value = true,
        hide_possible_values = true
    )]
    pub color: clap::ColorChoice,
}

static OUTPUT: OnceLock<OutputArgs> = OnceLock::new();

/// Sets the amount and the colours of output.
pub fn set_output(args: OutputArgs) {
    let _ = OUTPUT.set(args);
    match args.color {
        clap::ColorChoice::Auto => ColorChoice::Auto,
        clap::ColorChoice::Always => ColorChoice::AlwaysAnsi,
        clap::ColorChoice::Never => ColorChoice::Never,
    }
    .write_global();
}

/// Returns whether progress is hidden.
pub fn is_quiet() -> bool {
    OUTPUT.get().is_some_and(|output| output.quiet)
}

/// Returns whether to print more than usual.
pub fn is_verbose() -> bool {
    OUTPUT.get().is_some_and(|output| output.verbose)
}
