//! List of a run's failed cases.

use store::printable_lines;
use suite::Failure;

use crate::output::{bad, heading, wrap_lines};

/// Lists every failure with its reason; empty where there is none.
pub fn failures_text(failures: &[Failure]) -> String {
    let mut text = String::new();
    for failure in failures {
        let title = format!("{} / {}", failure.scene, failure.filter);
        let reason = format!("  {} {}", bad("FAILED"), failure.reason);
        text += &format!(
            "{}\n{}",
            heading(&title),
            wrap_lines(&printable_lines(&reason))
        );
    }
    text
}
