//! Arguments of `man`.

use std::path::PathBuf;

use clap::Args;

/// `shuttertruth man`
#[derive(Debug, Args)]
pub struct ManArgs {
    /// Folder for the pages: shuttertruth.1, and one for each command.
    #[arg(short, long, value_name = "DIR", default_value = "man")]
    pub out: PathBuf,
}
