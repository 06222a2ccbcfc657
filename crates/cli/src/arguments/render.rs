//! Arguments of `render`.

use clap::Args;
use frame::Alignment;

use super::parse::{
    Replicates, parse_frames, parse_noise, parse_replicates, parse_size, parse_whole,
};
use super::scenes::SceneArgs;

/// `shuttertruth render`
#[derive(Debug, Args)]
pub struct RenderArgs {
    #[command(flatten)]
    pub scenes: SceneArgs,
    /// Picture size in pixels [default: each scene's own].
    #[arg(help_heading = "Scenes and files", long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,
    /// Consecutive frames to render of every scene. Later frames lie in numbered folders below the scene's own.
    #[arg(help_heading = "Sequences", long, value_name = "N", default_value_t = 1, value_parser = parse_frames)]
    pub frames: u32,
    /// Shutter alignments of the truths, separated by commas.
    #[arg(
        help_heading = "Truths",
        long,
        value_delimiter = ',',
        default_value = "trailing",
        value_name = "ALIGNMENTS"
    )]
    pub alignments: Vec<Alignment>,
    /// Independent renders per truth: an even number, or a part A..B (A to B-1) that `merge` joins with others. Each has an
    /// eighth of --samples-per-pixel. The part with replicate 0 renders the frame too.
    #[arg(help_heading = "Truths", long, value_name = "N|A..B", default_value = "8", value_parser = parse_replicates)]
    pub replicates: Replicates,
    /// Render more replicates until the noise of each truth (root mean square radiance, where anything moves) is at most
    /// this. Exit code 4 if --most-replicates do not suffice.
    #[arg(help_heading = "Truths", long, value_name = "TARGET", value_parser = parse_noise)]
    pub noise: Option<f64>,
    /// Render the ladder of sub-frames of each truth too, which `run` measures with.
    #[arg(help_heading = "Truths", long)]
    pub ladders: bool,
    /// Upper limit on replicates for --noise.
    #[arg(
        help_heading = "Truths",
        long,
        value_name = "N",
        default_value_t = 64,
        value_parser = parse_whole::<u32>,
        requires = "noise"
    )]
    pub most_replicates: u32,
}
