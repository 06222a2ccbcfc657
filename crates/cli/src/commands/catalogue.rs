//! The command `catalogue`.

use report::catalogue;
use suite::{Error, estimate_run, open_gpu, printable_path, refuse_failures, run};

use super::expected::print_expected;
use super::plan::{claim_out, make_plan};
use crate::arguments::CatalogueArgs;
use crate::output::print::print;

/// Filter whose error the page shows where none is named.
const DEFAULT_FILTER: &str = "jump_flood:paper";

/// Runs one filter, or those that are named, and writes the page beside their pictures.
pub fn execute(args: &CatalogueArgs) -> Result<(), Error> {
    let mut measure = args.measure.clone();
    if measure.filters.is_empty() {
        measure.filters = vec![DEFAULT_FILTER.to_owned()];
    }
    // The page shows no noise.
    measure.jitter_frames = 0;
    let (plan, _) = make_plan(&measure, measure.scenes.out.clone())?;
    let gpu = open_gpu(&plan.filters, args.adapter.adapter.as_deref(), plan.monitor)?;
    let _claim = claim_out(&plan)?;
    print_expected(&estimate_run(&plan, gpu.as_ref()), &plan.out);
    let finished = run(&plan, gpu.as_ref(), std::env::args().collect())?;
    let page = plan.out.join("catalogue.md");
    frame::write_atomically(&page, catalogue(&finished).as_bytes())?;
    print(&format!("written: {}\n", printable_path(&page)))?;
    refuse_failures(&finished.failures)
}
