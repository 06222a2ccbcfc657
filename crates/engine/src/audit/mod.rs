//! Audit of an engine's picture against the scene: velocity, depth, and colour if it does not
//! depend on light.

mod audit_pictures;
mod capture_audit;
mod cause;
mod cause_words;
mod clear_pixels;
mod color_audit;
mod defect;
mod depth_audit;
mod expected_motion;
mod fitted_motion;
mod ranking;
mod shown;
mod structure;
mod table;
mod velocity_audit;
mod velocity_search;
mod views;

pub use audit_pictures::write_audit_picture;
pub use capture_audit::{AuditedScene, CaptureAudit, audit_capture};
pub use cause::Cause;
pub use defect::{Buffer, Defect};
pub use table::audit_table;
