//! Identities that name, match, sort and locate scenes, filters and cases.

mod case_id;
mod filter_id;
mod reference_picture;

pub use case_id::CaseId;
pub use filter_id::FilterId;
pub use reference_picture::{IDENTITY, ReferencePicture};
