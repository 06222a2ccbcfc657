//! The command `compare`.

use std::path::PathBuf;

use clap::Args;
use judge::compare_runs;
use measure::{Error, StoredRun};
use report::compare_page;

use crate::tables::compare_table;
use run::read_margins;
use run::write_page;
use terminal::arguments::RootArgs;
use terminal::output::{make_monitor, print, print_json};

#[derive(Debug, Args)]
pub struct CompareArgs {
    /// run.json of the first run, or its folder.
    #[arg(value_name = "RUN_A")]
    pub first: PathBuf,
    /// run.json of the second run, or its folder.
    #[arg(value_name = "RUN_B")]
    pub second: PathBuf,
    /// Write the comparison as an HTML page with the pictures that changed.
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    #[command(flatten)]
    pub root: RootArgs,
    /// Print all changes as JSON instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Reads two finished runs, prints what changed, and writes the page.
pub fn execute(args: &CompareArgs) -> Result<(), Error> {
    let (first, second) = (
        StoredRun::read(&args.first)?,
        StoredRun::read(&args.second)?,
    );
    let margins = read_margins(&args.root.scenes_dir)?;
    let compared = make_monitor().watch("cases that changed", |watch| {
        compare_runs(&first, &second, &margins, watch)
    })?;
    let written = match &args.html {
        Some(html) => write_page(&compare_page(&compared, &first, &second)?, html)?.line("written"),
        None => String::new(),
    };
    if args.json {
        return print_json(&compared);
    }
    print(&(compare_table(&compared) + &written))
}
