//! The words of the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use frame::{Alignment, VelocityKind};

/// How good is a real-time motion blur? Renders the truth of moving scenes, runs filters on one frame of each, and
/// measures how far they are from it.
#[derive(Debug, Parser)]
#[command(name = "shuttertruth", version, max_term_width = 100)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// List the adapters that filters can run on, and end.
    #[arg(long)]
    pub list_adapters: bool,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Render, filter, measure: the main job. Prints a table; writes run.json, EXR and PNG.
    Run(RunArgs),
    /// Render frames and truths alone.
    Render(RenderArgs),
    /// Run a filter on a frame file.
    Blur(BlurArgs),
    /// List scenes, filters, parameters and presets.
    List(ListArgs),
}

/// `shuttertruth run`
#[derive(Debug, Args)]
pub struct RunArgs {
    #[command(flatten)]
    pub scenes: SceneArgs,
    /// Filters: names or folders, each with an optional :preset, separated by commas [default: every built-in one].
    #[arg(long, value_delimiter = ',', value_name = "FILTERS")]
    pub filters: Vec<String>,
    /// A filter folder of your own; may be repeated. Runs beside those of --filters.
    #[arg(long, value_name = "FOLDER")]
    pub filter: Vec<String>,
    /// The preset of every filter [default: each preset in turn].
    #[arg(long, value_name = "NAME")]
    pub preset: Option<String>,
    /// Override a parameter; may be repeated.
    #[arg(long, value_name = "FILTER.PARAMETER=VALUE")]
    pub set: Vec<String>,
    /// Picture size in pixels.
    #[arg(long, value_name = "WxH", default_value = "320x180", value_parser = size)]
    pub size: (u32, u32),
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Print run.json to standard output instead of the table.
    #[arg(long)]
    pub json: bool,
}

/// `shuttertruth render`
#[derive(Debug, Args)]
pub struct RenderArgs {
    #[command(flatten)]
    pub scenes: SceneArgs,
    /// Picture size in pixels [default: each scene's own].
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Shutter alignments of the truths, separated by commas.
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "trailing",
        value_name = "ALIGNMENTS"
    )]
    pub alignments: Vec<Alignment>,
}

/// What `run` and `render` share.
#[derive(Debug, Args)]
pub struct SceneArgs {
    /// Scenes: names or folders, each with an optional @variant or @all, separated by commas [default: every one].
    #[arg(long, value_delimiter = ',', value_name = "SCENES")]
    pub scenes: Vec<String>,
    /// Folder that holds the scenes.
    #[arg(long, value_name = "FOLDER", default_value = "scenes")]
    pub scenes_dir: PathBuf,
    /// Samples per pixel of a truth, over 8 replicates: 8 times a power of two.
    #[arg(long, value_name = "N", default_value_t = 256)]
    pub samples_per_pixel: u32,
    /// Exposure in frames; 0.5 is a shutter of 180 degrees [default: each scene's own].
    #[arg(long, value_name = "E")]
    pub exposure: Option<f64>,
    /// What the velocity buffer holds: instantaneous or previous_frame.
    #[arg(long, value_name = "KIND", default_value_t = VelocityKind::Instantaneous)]
    pub velocity: VelocityKind,
    /// Threads that render [default: one per core].
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
    /// Seed of all randomness.
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Folder for all files. Truths found there are used again if nothing about them has changed.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// No progress bars.
    #[arg(long)]
    pub quiet: bool,
}

/// `shuttertruth blur`
#[derive(Debug, Args)]
pub struct BlurArgs {
    /// Filter: a name or a folder, with an optional :preset.
    #[arg(long, value_name = "FILTER")]
    pub filter: String,
    /// The preset [default: the filter's first].
    #[arg(long, value_name = "NAME")]
    pub preset: Option<String>,
    /// Override a parameter; may be repeated.
    #[arg(long, value_name = "FILTER.PARAMETER=VALUE")]
    pub set: Vec<String>,
    /// OpenEXR file with the channels R G B, Z, velocity.X, velocity.Y.
    #[arg(long, value_name = "FILE")]
    pub frame: PathBuf,
    /// Exposure in frames [default: the file's attribute "exposure"].
    #[arg(long, value_name = "E")]
    pub exposure: Option<f64>,
    /// Frame number that the filter's noise starts from.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub frame_index: u32,
    /// OpenEXR file to write.
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

/// `shuttertruth list`
#[derive(Debug, Args)]
pub struct ListArgs {
    /// Folder that holds the scenes.
    #[arg(long, value_name = "FOLDER", default_value = "scenes")]
    pub scenes_dir: PathBuf,
    /// A filter folder of your own to list as well; may be repeated.
    #[arg(long, value_name = "FOLDER")]
    pub filter: Vec<String>,
    /// Print JSON.
    #[arg(long)]
    pub json: bool,
}

/// What filters run on.
#[derive(Debug, Args)]
pub struct AdapterArgs {
    /// Adapter: its number in --list-adapters or a part of its name [default: the fastest].
    #[arg(long, value_name = "ADAPTER")]
    pub adapter: Option<String>,
}

/// `640x360` as (640, 360).
fn size(text: &str) -> Result<(u32, u32), String> {
    let parsed = text
        .split_once('x')
        .and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    match parsed {
        Some((width @ 16..=16384, height @ 16..=16384)) => Ok((width, height)),
        _ => {
            Err("allowed is WIDTHxHEIGHT, each from 16 to 16384 pixels, such as 640x360".to_owned())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn a_size_is_two_numbers() {
        assert_eq!(size("640x360"), Ok((640, 360)));
        for wrong in [
            "640",
            "640x",
            "x360",
            "0x360",
            "640x99999",
            "640 x 360",
            "-1x5",
        ] {
            assert!(
                size(wrong).unwrap_err().contains("640x360"),
                "{wrong} must be refused"
            );
        }
    }
}
