//! `shuttertruth report`

use std::path::Path;

use suite::{Error, LARGEST_PAGE, Run, report};

use super::say;
use crate::cli::ReportArgs;

/// Reads a finished run and writes its page.
pub fn execute(args: &ReportArgs) -> Result<(), Error> {
    let run = Run::read(&args.run)?;
    let folder = args.run.parent().unwrap_or(Path::new(""));
    let report = report(&run, folder, &args.html, LARGEST_PAGE)?;
    report.write()?;
    let megabytes = |bytes: usize| bytes as f64 / 1e6;
    let mut text = format!(
        "written: {} ({:.1} MB)\n",
        args.html.display(),
        megabytes(report.page.len())
    );
    if let Some((first, _)) = report.siblings.first() {
        let folder = first.parent().unwrap_or(Path::new(""));
        text += &format!(
            "and beside it, to be kept with it: {} ({:.1} MB)\n",
            folder.display(),
            megabytes(report.bytes() - report.page.len())
        );
    }
    say(&text)
}
