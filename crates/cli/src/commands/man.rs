//! The command `man`.

use std::path::PathBuf;

use clap::Args;
use frame::FileError;
use store::printable_path;
use suite::Error;

use crate::output::print;

#[derive(Debug, Args)]
pub struct ManArgs {
    /// Folder for the pages: shuttertruth.1, and one for each command.
    #[arg(short, long, value_name = "DIR", default_value = "man")]
    pub out: PathBuf,
}

/// Writes a page of the manual for the program and for each command.
pub fn execute(args: &ManArgs, program: clap::Command) -> Result<(), Error> {
    let fail = |source| FileError::io(&args.out, "write", source);
    std::fs::create_dir_all(&args.out).map_err(fail)?;
    clap_mangen::generate_to(program, &args.out).map_err(fail)?;
    print(&format!("written: {}\n", printable_path(&args.out)))
}
