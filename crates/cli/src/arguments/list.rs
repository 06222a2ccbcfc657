//! Arguments of `list`.

use std::path::PathBuf;

use clap::Args;

use super::adapter::AdapterArgs;

/// `shuttertruth list`
#[derive(Debug, Args)]
pub struct ListArgs {
    /// Folder that holds the scenes.
    #[arg(long, value_name = "FOLDER", default_value = "scenes")]
    pub scenes_dir: PathBuf,
    /// A filter folder of your own to list as well, and to try out with every preset and at both ends of every range;
    /// repeatable.
    #[arg(long, value_name = "FOLDER")]
    pub filter: Vec<String>,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Print JSON.
    #[arg(long)]
    pub json: bool,
}
