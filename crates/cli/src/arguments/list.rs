//! Arguments of `list`.

use clap::Args;
use tracer::Location;

use super::adapter::AdapterArgs;
use super::scenes_root::{default_scenes_root, scenes_root_parser};

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
    /// Folder that holds the scenes; built-in names the program's own [default: scenes, or
    /// built-in where there is no such folder].
    #[arg(long, value_name = "FOLDER", value_parser = scenes_root_parser(), default_value_t = default_scenes_root(), hide_default_value = true)]
    pub scenes_dir: Location,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Print JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
