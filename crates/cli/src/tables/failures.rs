//! List of a run's failed cases.

use store::{printable, printable_lines};
use suite::Failure;

use crate::output::{bad, heading, push_wrapped};

/// Lists every failure with its reason; empty where there is none.
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
