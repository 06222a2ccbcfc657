//! The words of `render` and `merge`.

use std::ops::Range;
use std::path::PathBuf;

use clap::Args;
use frame::Alignment;

use super::SceneArgs;
use crate::arguments::values::{noise, replicates, size};

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
    /// Independent renders behind each truth: an even number, or a part A..B (from A to B-1) to be joined with others by
    /// `merge`. Each has an eighth of --samples-per-pixel. The part with replicate 0 renders the frame too.
    #[arg(long, value_name = "N|A..B", default_value = "8", value_parser = replicates)]
    pub replicates: Replicates,
    /// Render more replicates until the noise of each truth (root mean square radiance, where anything moves) is at
    /// most this; ends with exit code 4 where --most-replicates do not suffice.
    #[arg(long, value_name = "TARGET", value_parser = noise)]
    pub noise: Option<f64>,
    /// The most replicates that --noise may render.
    #[arg(long, value_name = "N", default_value_t = 64, requires = "noise")]
    pub most_replicates: u32,
}

/// How many replicates, or which.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Replicates {
    /// All of a truth that has so many.
    All(u32),
    /// Some, by their indices.
    Part(Range<u32>),
}

/// `shuttertruth merge`
#[derive(Debug, Args)]
pub struct MergeArgs {
    /// Folders that `render --replicates A..B --out` wrote.
    #[arg(required = true, value_name = "FOLDER")]
    pub parts: Vec<PathBuf>,
    /// Folder for the whole: what one machine would have written.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}
