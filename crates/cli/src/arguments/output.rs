//! Arguments that say how much a command prints, and in which colours.

use clap::{Args, ValueEnum};

/// Amount and colours of output; every command has these arguments.
#[derive(Clone, Copy, Debug, Args)]
#[command(next_help_heading = "Output")]
pub struct OutputArgs {
    /// Show no progress.
    #[arg(short, long, global = true)]
    pub quiet: bool,
    /// Show more: targets that are missed, and messages of the graphics driver.
    #[arg(short, long, global = true)]
    pub verbose: bool,
    /// Colours: auto (on a terminal, unless NO_COLOR is set), always or never.
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto", value_parser = parse_color, hide_default_value = true)]
    pub color: Color,
}

/// Choice of colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Color {
    /// On a terminal.
    Auto,
    /// Everywhere.
    Always,
    /// Nowhere.
    Never,
}

/// Parses a choice of colours. The option once chose the sampling of the frame.
fn parse_color(text: &str) -> Result<Color, String> {
    match text {
        "antialiased" | "point" => Err(format!(
            "--color is about the terminal; the sampling of the frame is --frame-sampling {text}"
        )),
        _ => Color::from_str(text, false).map_err(|_| "allowed: auto, always or never".to_owned()),
    }
}
