//! The command `compare`.

use std::path::{Path, PathBuf};

use clap::Args;
use judge::compare_runs;
use measure::{Error, StoredRun};
use report::compare_page;

use crate::tables::{compare_csv, compare_markdown, compare_table};
use run::write_page;
use run::{PREVIOUS, read_margins};
use terminal::arguments::RootArgs;
use terminal::output::{make_monitor, open_page, print, print_json};
use terminal::refuse;
use terminal::table::TableArgs;

#[derive(Debug, Args)]
pub struct CompareArgs {
    /// Folder of a run, or its run.json; alone, what changed since the run before it in the same
    /// folder.
    #[arg(value_name = "RUN", default_value = "out")]
    pub first: PathBuf,
    /// The second run; changes are from the first to this one.
    #[arg(value_name = "OTHER")]
    pub second: Option<PathBuf>,
    /// Write the comparison as an HTML page with the pictures that changed.
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Open the page in the browser [default page: compare.html next to the second run.json].
    #[arg(long)]
    pub open: bool,
    #[command(flatten)]
    pub root: RootArgs,
    /// Print all changes as JSON instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
    #[command(flatten)]
    pub tables: TableArgs,
}

/// Reads a run, and the one before it in the same folder.
fn read_previous(path: &Path) -> Result<(StoredRun, StoredRun), Error> {
    let last = StoredRun::read(path)?;
    let previous = last.folder().join(PREVIOUS);
    if !previous.exists() {
        refuse!(
            "{}: there was one run only, and no other to compare with; run it again after a change, or name two runs",
            last.folder().display()
        );
    }
    Ok((StoredRun::read(&previous)?, last))
}

/// Reads two finished runs, prints what changed, and writes the page.
pub fn execute(args: &CompareArgs) -> Result<(), Error> {
    let (first, second) = match &args.second {
        Some(second) => (StoredRun::read(&args.first)?, StoredRun::read(second)?),
        None => read_previous(&args.first)?,
    };
    let margins = read_margins(&args.root.scenes_dir)?;
    let compared = make_monitor().watch("cases that changed", |watch| {
        compare_runs(&first, &second, &margins, watch)
    })?;
    let opened = args.open.then(|| second.folder().join("compare.html"));
    let written = match args.html.clone().or(opened) {
        Some(html) => {
            let page = compare_page(&compared, &first, &second)?;
            let written = write_page(&page, &html)?.line("written");
            if args.open {
                open_page(&html);
            }
            written
        }
        None => String::new(),
    };
    let markdown = || compare_markdown(&compared);
    if args.tables.write(|| compare_csv(&compared), markdown)? {
        return Ok(());
    }
    if args.json {
        return print_json(&compared);
    }
    print(compare_table(&compared) + written)
}
