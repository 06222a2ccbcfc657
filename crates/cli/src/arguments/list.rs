//! Arguments of `list`.

use std::path::PathBuf;

use clap::Args;

use super::adapter::AdapterArgs;

/// `shuttertruth list`
#[derive(Debug, Args)]
pub struct ListArgs {
    /// Things to list: scenes, filters, adapters, or names or patterns of scenes and filters, which are shown in detail
    /// [default: scenes and filters].
    #[arg(value_name = "WHAT")]
    pub what: Vec<String>,
    /// Filters to list in detail: names, folders or patterns; repeatable, or separated by commas. A filter of your own is tried
    /// out with every preset and at both ends of every range.
    #[arg(
        long = "filter",
        visible_alias = "filters",
        value_delimiter = ',',
        value_name = "FILTERS"
    )]
    pub filters: Vec<String>,
    /// Folder that holds the scenes.
    #[arg(long, value_name = "FOLDER", default_value = "scenes")]
    pub scenes_dir: PathBuf,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Print JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
