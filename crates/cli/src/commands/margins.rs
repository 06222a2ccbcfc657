//! Margins of scores, in the folder of scenes.

use std::collections::BTreeMap;

use judge::{BOUNDS_FILE, Margin, read_bounds_file};
use metrics::Metric;
use suite::Error;
use tracer::Location;

/// Margins by the names of metrics.
pub type Margins = BTreeMap<Metric, Margin>;

/// Reads the margins by which scores may differ before it matters; none where the folder has no bounds.
pub fn read_margins(root: &Location) -> Result<Margins, Error> {
    let file = root.join(BOUNDS_FILE);
    match file.exists() {
        true => Ok(read_bounds_file(&file)?.margins),
        false => Ok(BTreeMap::new()),
    }
}
