//! The command `compare`.

use judge::{Side, compare_runs};
use report::compare_page;
use suite::Error;

use super::margins::read_margins;
use super::pages::write_page;
use crate::arguments::CompareArgs;
use crate::output::print::{print, print_json};
use crate::output::progress::make_monitor;
use crate::tables::comparison::compare_table;

/// Reads two finished runs, prints what changed, and writes the page.
pub fn execute(args: &CompareArgs) -> Result<(), Error> {
    let (first, second) = (Side::read(&args.first)?, Side::read(&args.second)?);
    let mut compared = make_monitor().watch("cases that changed", |watch| {
        compare_runs(&first, &second, watch)
    })?;
    compared.apply_margins(&read_margins(&args.scenes_dir)?);
    let written = match &args.html {
        Some(html) => write_page(&compare_page(&compared, &first, &second)?, html)?.line("written"),
        None => String::new(),
    };
    if args.json {
        return print_json(&compared);
    }
    print(&(compare_table(&compared) + &written))
}
