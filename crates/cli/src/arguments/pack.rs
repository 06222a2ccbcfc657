//! Arguments of `pack`.

use std::path::PathBuf;

use clap::Args;

/// `shuttertruth pack`
#[derive(Debug, Args)]
pub struct PackArgs {
    /// Folder of a finished run: --out of `run` or `check`.
    #[arg(value_name = "RUN", default_value = "out")]
    pub run: PathBuf,
    /// Scenes of the run: names with their @variant, or patterns such as 'rail*'; repeatable, or separated by commas [default: all].
    #[arg(
        long,
        visible_alias = "scene",
        value_delimiter = ',',
        value_name = "SCENES"
    )]
    pub scenes: Vec<String>,
    /// Archive to write.
    #[arg(short, long, value_name = "FILE", default_value = "truths.tar.zst")]
    pub out: PathBuf,
    /// Print the manifest of the pack as JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
