//! What engines draw, and what they draw from: scenes exported and imported, captures read, ingested and audited.

mod audit;
mod capture;
mod export;
mod import;
mod ingest;

pub use audit::{
    Buffer, CaptureAudit, Cause, Defect, DepthAudit, ObjectAudit, ObjectShown, audit_capture,
    write_audit_picture,
};
pub use capture::description::{CAPTURE_FILE, CaptureDescription};
pub use capture::folder::Capture;
pub use export::{
    ExportError, FRAMES_PER_SECOND, MANIFEST_FORMAT, Manifest, ManifestLens, Timeline, export_gltf,
};
pub use import::{ImportPlan, Imported, Motions, Up, import};
pub use ingest::{Ingested, ingest};
