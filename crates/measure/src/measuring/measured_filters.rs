//! Copies of the user's own filters as a run measured them, for pages that run them again.

use std::fs;

use frame::{FileError, write_atomically};

use super::plan::RunPlan;
use crate::Error;

/// Folder of the copies in the folder of a run; each is a filter folder.
pub const MEASURED_FILTERS: &str = "measured_filters";

/// Writes each filter of a plan that is neither built in nor a program, in WGSL: without a
/// compiler, and without what its shaders include. Removes the copy of another filter of the same
/// name.
pub(crate) fn copy_filters(plan: &RunPlan) -> Result<(), Error> {
    for choice in &plan.filters {
        let filter = &choice.filter;
        let copy = plan.out.join(MEASURED_FILTERS).join(&filter.name);
        if filter.command.is_some() {
            continue;
        }
        let manifest = copy.join("filter.toml");
        if manifest.is_file() {
            fs::remove_file(&manifest)
                .map_err(|source| FileError::io(&manifest, "remove", source))?;
        }
        if filter.folder.is_none() {
            continue;
        }
        for (file, text) in filter.wgsl_files().unwrap_or_default() {
            write_atomically(&copy.join(file), text.as_bytes())?;
        }
    }
    Ok(())
}
