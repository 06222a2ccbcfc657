//! `shuttertruth report`

use std::path::Path;

use suite::{Error, Run, report};

use super::say;
use crate::cli::ReportArgs;

/// Reads a finished run and writes its page.
pub fn execute(args: &ReportArgs) -> Result<(), Error> {
    let run = Run::read(&args.run)?;
    let folder = args.run.parent().unwrap_or(Path::new(""));
    let page = report(&run, folder)?;
    frame::write_atomically(&args.html, page.as_bytes())?;
    say(&format!(
        "written: {} ({:.1} MB)\n",
        args.html.display(),
        page.len() as f64 / 1e6
    ))
}
