//! Arguments of `merge`.

use std::path::PathBuf;

use clap::Args;

/// `shuttertruth merge`
#[derive(Debug, Args)]
pub struct MergeArgs {
    /// Folders that `render --replicates A..B` wrote; or those of finished runs, each with other scenes or filters.
    #[arg(required = true, value_name = "FOLDER")]
    pub parts: Vec<PathBuf>,
    /// Folder for the whole, as one machine would have written it.
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Words of the command line that run.json records; `plan` gives those of the whole run [default: those of this command].
    #[arg(last = true, value_name = "COMMAND")]
    pub command: Vec<String>,
}
