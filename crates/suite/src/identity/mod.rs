//! Identities, by which scenes, filters and cases are named, matched, sorted and found in folders.

mod case_id;
mod filter_id;

pub use case_id::CaseId;
pub use filter_id::FilterId;
