//! Exchange with engines: scenes exported and imported, captures read, ingested and audited.

mod audit;
mod capture;
mod export;
mod files;
mod import;
mod ingest;
mod statistics;

pub use audit::{
    Buffer, CaptureAudit, Cause, Defect, ObjectAudit, ObjectShown, audit_capture,
    write_audit_picture,
};
pub use capture::description::CaptureDescription;
pub use capture::folder::Capture;
pub use export::{FRAMES_PER_SECOND, Manifest, Timeline, export_gltf};
pub use import::{ImportPlan, Imported, Motions, Up, import};
pub use ingest::{Ingested, check_subframe_count, ingest};
