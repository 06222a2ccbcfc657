//! The failed cases of a run, with their reasons.

use suite::{Failure, printable, printable_lines};

use crate::output::paint::{bad, heading};
use crate::output::wrapped::push_wrapped;

/// Every failure with its reason; nothing where there is none.
pub fn failures_text(failures: &[Failure]) -> String {
    let mut text = String::new();
    for failure in failures {
        let title = format!("{} / {}", failure.scene, failure.filter);
        text += &heading(&printable(&title));
        text.push('\n');
        let reason = printable_lines(&failure.reason);
        push_wrapped(&mut text, 2, &format!("{} {reason}", bad("FAILED")));
    }
    text
}
