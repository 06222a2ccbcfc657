//! What came of measuring a case.

use crate::run::case::Case;
use crate::run::failure::Failure;

/// What came of measuring a case.
pub(super) enum Attempt {
    /// Its scores.
    Measured(Box<Case>),
    /// Its filter made no measurable picture.
    Failed(Failure),
}
