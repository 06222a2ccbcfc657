//! Arguments of commands that measure scenes: `run`, `check` and `limits calibrate`.

use std::path::PathBuf;

use clap::Args;
use frame::Size;

use super::{
    InputFormArgs, ProgramArgs, SceneArgs, above_zero, filter_names, parse_even, parse_size, within,
};

/// Choice of scenes, filters and inputs to measure.
#[derive(Clone, Debug, Args)]
pub struct MeasureArgs {
    /// Scenes and sizes.
    #[command(flatten)]
    pub scenes: SceneArgs,
    /// Filters: names, folders or patterns such as 'jump*', each with an optional :preset;
    /// repeatable, or separated by commas [default: all built-in ones].
    #[arg(
        help_heading = "Filters",
        long = "filter",
        visible_alias = "filters",
        value_delimiter = ',',
        value_name = "FILTERS",
        value_parser = filter_names(),
        hide_possible_values = true
    )]
    pub filters: Vec<String>,
    /// Preset of every filter [default: all presets].
    #[arg(help_heading = "Filters", long, value_name = "NAME")]
    pub preset: Option<String>,
    /// Override a parameter; repeatable.
    #[arg(help_heading = "Filters", long, value_name = "FILTER.PARAMETER=VALUE")]
    pub set: Vec<String>,
    /// Keep lengths in pixels as the preset has them [default: scale them from the width that the
    /// preset was made for to the picture's].
    #[arg(help_heading = "Filters", long)]
    pub as_written: bool,
    /// Picture size in pixels. If --out holds a run of another size, this one goes to a folder
    /// below it, such as out/160x90 [default: 320x180; for `check`, the size that the bounds hold
    /// at].
    #[arg(help_heading = "Scenes and files", long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<Size>,
    /// Noise of truth and frame, a root mean square of radiance where anything moves: two small
    /// renders tell how many samples per pixel the noisiest of the scenes takes for it.
    #[arg(help_heading = "Scenes and files", long, value_name = "TARGET", value_parser = above_zero(f64::MAX), conflicts_with = "samples_per_pixel")]
    pub noise: Option<f64>,
    /// Independent renders per truth, an even number; each has an eighth of --samples-per-pixel.
    #[arg(
        help_heading = "Scenes and files",
        long,
        value_name = "N",
        default_value_t = 8,
        value_parser = parse_even
    )]
    pub replicates: u32,
    /// Forms of the input.
    #[command(flatten)]
    pub forms: InputFormArgs,
    /// Frames of noise, to separate a noisy filter's noise from its other errors; 0 for none.
    #[arg(help_heading = "Filters", long, value_name = "N", default_value_t = 16, value_parser = within::<u32>(0..=1024))]
    pub jitter_frames: u32,
    /// Folder laid out as --out, with frames, truths and ladders. Those of the same inputs are not
    /// rendered again.
    #[arg(help_heading = "Scenes and files", long, value_name = "DIR")]
    pub truths: Option<PathBuf>,
    /// Remove the truths and cases of these scenes in --out first.
    #[arg(help_heading = "Scenes and files", long, conflicts_with = "truths")]
    pub no_cache: bool,
    /// Whether filters that are programs may run.
    #[command(flatten)]
    pub programs: ProgramArgs,
}
