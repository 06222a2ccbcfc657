//! `shuttertruth catalogue`

use report::catalogue;
use suite::{Error, measure_scenes, open_gpu, refuse_failures};

use super::measure::{claim_out, plan};
use super::say;
use crate::arguments::CatalogueArgs;

/// The filter whose error is shown where none is named.
const SHOWN: &str = "jump_flood:paper";

/// Runs one filter, or those that are named, and writes the page beside their pictures.
pub fn execute(args: &CatalogueArgs) -> Result<(), Error> {
    let mut measure = args.measure.clone();
    if measure.filters.is_empty() && measure.filter.is_empty() {
        measure.filters = vec![SHOWN.to_owned()];
    }
    // The page shows no noise.
    measure.jitter_frames = 0;
    let (plan, _) = plan(&measure, measure.scenes.out.clone())?;
    let gpu = open_gpu(&plan.filters, args.adapter.adapter.as_deref(), plan.monitor)?;
    let _claim = claim_out(&plan)?;
    let run = measure_scenes(&plan, gpu.as_ref(), std::env::args().collect())?;
    let page = plan.out.join("catalogue.md");
    frame::write_atomically(&page, catalogue(&run).as_bytes())?;
    say(&format!("written: {}\n", suite::printable_path(&page)))?;
    refuse_failures(&run.failures)
}
