//! Margins of scores, in the folder of scenes.

use std::collections::BTreeMap;
use std::path::Path;

use suite::{BOUNDS_FILE, Error, Margin, read_bounds_file};

/// Reads the margins by which scores may differ before it matters; none where the folder has no bounds.
pub fn read_margins(root: &Path) -> Result<BTreeMap<String, Margin>, Error> {
    let path = root.join(BOUNDS_FILE);
    match path.exists() {
        true => Ok(read_bounds_file(&path)?.margins),
        false => Ok(BTreeMap::new()),
    }
}
