//! The command `compare`.

use std::path::{Path, PathBuf};

use clap::Args;
use judge::{compare_runs, pair_cases};
use measure::{Error, StoredRun, estimate_case_seconds};
use report::compare_page;

use crate::pages::write_page;
use crate::plan::read_margins;
use crate::previous::PREVIOUS;
use crate::tables::{compare_csv, compare_markdown, compare_table};
use terminal::arguments::RootArgs;
use terminal::expected::print_expected_time;
use terminal::output::{count_text, make_monitor, open_page, print, print_json};
use terminal::refuse;
use terminal::table::TableArgs;

/// Arguments of `compare`.
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
    /// Folder of scenes.
    #[command(flatten)]
    pub root: RootArgs,
    /// Print all changes as JSON instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
    /// Other forms of the table.
    #[command(flatten)]
    pub tables: TableArgs,
}

/// Prints the expected time to measure both pictures of every case that changed, against the truth
/// and against it without each pair of its replicates.
fn print_expected_compare(first: &StoredRun, second: &StoredRun) {
    let pairs = pair_cases(&first.run, &second.run);
    let changed = pairs
        .iter()
        .filter(|pair| pair.first.scores != pair.second.scores);
    let changed = changed.count();
    let truths = f64::from(1 + first.run.render.replicates / 2);
    let seconds = changed as f64 * 2.0 * truths * estimate_case_seconds(&first.run.render);
    print_expected_time(
        seconds,
        &count_text(changed, "changed case", "changed cases"),
    );
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
    print_expected_compare(&first, &second);
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
