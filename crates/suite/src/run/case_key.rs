//! Identity of cases.

use frame::Alignment;

use super::case::Case;

/// Identity of a case in a folder of runs, whatever values `--set` gave to its parameters: a run with other values replaces it.
/// Scene, filter with its preset, alignment, and true for a reference.
pub(crate) type CaseKey = (String, String, Alignment, bool);

/// Returns the identity of a case.
pub(crate) fn key(case: &Case) -> CaseKey {
    (
        case.scene.clone(),
        case.preset_name(),
        case.alignment,
        case.is_reference,
    )
}
