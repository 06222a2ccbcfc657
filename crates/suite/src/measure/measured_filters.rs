//! Copies of the user's own filters as a run measured them, for pages that run them again.

use std::fs;

use frame::{FileError, write_atomically};

use super::plan::RunPlan;
use crate::Error;

/// Folder of the copies in the folder of a run; each is a filter folder.
pub const MEASURED_FILTERS: &str = "measured_filters";

/// Copies filter.toml and the shaders of each filter of a plan that is neither built in nor a program. Removes the copy of another filter of
/// the same name. A shader outside of the filter's folder is left out.
pub(crate) fn copy_filters(plan: &RunPlan) -> Result<(), Error> {
    for choice in &plan.filters {
        let filter = &choice.filter;
        let copy = plan.out.join(MEASURED_FILTERS).join(&filter.name);
        let manifest = copy.join("filter.toml");
        if filter.command.is_some() {
            continue;
        }
        let Some(folder) = &filter.folder else {
            if manifest.is_file() {
                fs::remove_file(&manifest)
                    .map_err(|source| FileError::io(&manifest, "remove", source))?;
            }
            continue;
        };
        for path in filter.list_files() {
            let Ok(below) = path.strip_prefix(folder) else {
                continue;
            };
            let bytes = fs::read(path).map_err(|source| FileError::io(path, "read", source))?;
            write_atomically(&copy.join(below), &bytes)?;
        }
    }
    Ok(())
}
