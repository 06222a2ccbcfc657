//! Decision of a check.

use serde::Serialize;

/// Result of a check; a later one outweighs an earlier one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Decision {
    /// Every required bound is met.
    Pass,
    /// For some the truth is too noisy to tell.
    Inconclusive,
    /// A bound is stricter than the truth's noise can carry, or no bound applies to a case.
    Misconfigured,
    /// A required bound is broken, or a case failed. The noise of another bound does not undo it.
    Broken,
}
