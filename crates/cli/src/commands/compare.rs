//! `shuttertruth compare`

use crate::output::progress::monitor;
use crate::tables::comparison::compare_table;
use report::compare_page;
use suite::{Error, Side, compare_runs};

use super::report::write_page;
use super::say;
use crate::arguments::CompareArgs;

/// Reads two finished runs, prints what changed, and writes the page.
pub fn execute(args: &CompareArgs) -> Result<(), Error> {
    let (first, second) = (Side::read(&args.first)?, Side::read(&args.second)?);
    let compared = monitor(args.quiet).watch("cases that changed", |watch| {
        compare_runs(&first, &second, watch)
    })?;
    let written = match &args.html {
        Some(html) => write_page(&compare_page(&compared, &first, &second)?, html)?.line(),
        None => String::new(),
    };
    if args.json {
        let json = serde_json::to_string_pretty(&compared).expect("a comparison is plain data");
        return say(&format!("{json}\n"));
    }
    say(&(compare_table(&compared) + &written))
}
