//! Bounds, tuning, and tuned presets.

mod bars;
mod bounds;
mod planted_defects;
mod shipped_bounds;
mod tune;
mod tuned_presets;

use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Locks and returns the folder of truths, which stay from one run of the tests to the next: two tests that need the
/// same truths render them once.
fn lock_truths() -> (PathBuf, MutexGuard<'static, ()>) {
    static IN_USE: Mutex<()> = Mutex::new(());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("truths");
    (
        folder,
        IN_USE.lock().unwrap_or_else(PoisonError::into_inner),
    )
}
