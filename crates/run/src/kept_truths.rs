//! Truths of `--truths`.

use std::path::Path;
use terminal::refuse;

use measure::Error;

use terminal::output::print_note;

/// Refuses a path that is no folder, before anything is rendered. Prints that the truths there
/// decide the verdict.
pub fn check_truths(truths: &Path) -> Result<(), Error> {
    if !truths.is_dir() {
        refuse!(
            "--truths {}: {}; allowed: a folder into which `shuttertruth truths render --ladders` or `run` wrote",
            truths.display(),
            if truths.exists() {
                "is no folder"
            } else {
                "there is no such folder"
            }
        );
    }
    print_note(&format!(
        "whoever wrote {} decides the scores and the verdict: its truths are believed",
        truths.display()
    ));
    Ok(())
}
