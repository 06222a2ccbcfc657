//! Arguments of `bench`.

use std::path::PathBuf;

use clap::Args;

use super::adapter::AdapterArgs;
use super::parse::{parse_rounds, parse_size};

/// `shuttertruth bench`
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Filters: names, folders or patterns such as 'jump*', each with an optional :preset; repeatable, or separated by commas
    /// [default: all built-in ones]. jump_flood:paper, which times are relative to, is timed as well.
    #[arg(
        long = "filter",
        visible_alias = "filters",
        value_delimiter = ',',
        value_name = "FILTERS"
    )]
    pub filters: Vec<String>,
    /// Picture size in pixels [default: 1920x1080, or 320x180 on a software adapter].
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,
    /// Times that each filter is timed, in turns with the others; 20 or more.
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = parse_rounds)]
    pub rounds: u32,
    /// Keep lengths in pixels as the preset has them [default: scale them from the width that the preset was made for to the
    /// picture's].
    #[arg(long)]
    pub as_written: bool,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Folder for bench.json.
    #[arg(
        help_heading = "Output",
        short,
        long,
        value_name = "DIR",
        default_value = "out"
    )]
    pub out: PathBuf,
    /// Print bench.json to standard output instead of the tables.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
