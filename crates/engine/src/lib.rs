//! Exchange with engines: scenes exported and imported, captures read, ingested and audited.

mod audit;
mod audit_self;
mod capture;
pub mod command;
mod export;
mod files;
mod import;
mod ingest;
mod statistics;

pub use audit::{AuditedScene, Buffer, CaptureAudit, Cause, Defect, audit_capture};
pub use audit_self::{
    Estimate, PairAudit, Reason, RegionAudit, SelfFinding, SequenceAudit, SimpleCause, Verdict,
    audit_frames,
};
pub use capture::description::CaptureDescription;
pub use capture::folder::Capture;
pub use export::{FRAMES_PER_SECOND, Timeline, export_gltf};
