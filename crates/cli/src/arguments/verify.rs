//! Arguments of `verify`.

use std::path::PathBuf;

use clap::Args;
use tracer::Location;

use super::parse::{parse_tiles, parse_whole};
use super::scenes_root::{default_scenes_root, scenes_root_parser};

/// `shuttertruth verify`
#[derive(Debug, Args)]
pub struct VerifyArgs {
    /// Pack, or folder into which `run`, `check` or `render` wrote.
    #[arg(value_name = "FILE|DIR", default_value = "out")]
    pub truths: PathBuf,
    /// Scenes to verify: names with their @variant, or patterns such as 'rail*'; repeatable, or separated by commas [default: all].
    #[arg(
        long,
        visible_alias = "scene",
        value_delimiter = ',',
        value_name = "SCENES"
    )]
    pub scenes: Vec<String>,
    /// Folder that holds the scenes; built-in names the program's own [default: scenes, or
    /// built-in where there is no such folder].
    #[arg(long, value_name = "FOLDER", value_parser = scenes_root_parser(), default_value_t = default_scenes_root(), hide_default_value = true)]
    pub scenes_dir: Location,
    /// Seed of the choice of replicates, rungs and tiles [default: another one each time, which is printed].
    #[arg(long, value_name = "S", value_parser = parse_whole::<u64>)]
    pub seed: Option<u64>,
    /// Tiles of 16x16 pixels to trace again of each frame, each truth and each ladder.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = parse_tiles)]
    pub tiles: u32,
    /// Threads that render [default: one per core].
    #[arg(long, value_name = "N", value_parser = parse_whole::<usize>)]
    pub threads: Option<usize>,
    /// Print what was verified as JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
